// C++ that SymForce wrote of K and the right side of (8), as a peer; solved by Eigen's LDLT. The record is the flat input.
#include "peer.h"

#include "literal.h"

#include <Eigen/Cholesky>

#include <cstring>

namespace {

constexpr int inputs = 12 + 4 * FLYWHEELS;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Flywheels = Eigen::Matrix<double, FLYWHEELS, 1>;

} // namespace

extern "C" {

int peer_setup(const char *) { return 0; }
int peer_size(void) { return inputs; }
int peer_V(void) { return 0; }
int peer_phi(void) { return 6; }
void peer_pack(const double *flat, double *record) { std::memcpy(record, flat, inputs * sizeof *record); }

void peer_forward(const double *record, double *out)
{
    const Vector6 V = Eigen::Map<const Vector6>(record);
    const Flywheels phi = Eigen::Map<const Flywheels>(record + 6);
    const Flywheels phi_dot = Eigen::Map<const Flywheels>(record + 6 + FLYWHEELS);
    const Flywheels phi_ddot = Eigen::Map<const Flywheels>(record + 6 + 2 * FLYWHEELS);
    Matrix6 K;
    Vector6 b;

    sym::Literal<double>(V, phi, phi_dot, phi_ddot, &K, &b);
    Eigen::Map<Vector6>(out, 6) = K.ldlt().solve(b);
}

} // extern "C"
