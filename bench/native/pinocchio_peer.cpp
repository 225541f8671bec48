// Pinocchio as a peer: forward by CRBA, RNEA and Eigen's LDLT of the 6x6 block; coupled by ABA; torque by RNEA;
// the slopes of coupled by its analytical derivatives of ABA. The model file: number of bodies, then for each body 12
// numbers of its place in the carrier (rotation by rows, position), mass, centre (3), central inertia by rows (9).
#include "peer.h"

#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <cstdio>
#include <memory>

namespace pin = pinocchio;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Constant = Eigen::Map<const Eigen::VectorXd>;

namespace {

struct Bench {
    pin::Model model;
    pin::Data data;
    int flywheels;
    Eigen::VectorXd acceleration; // of forward: zero for the carrier

    explicit Bench(const pin::Model &m)
        : model(m), data(m), flywheels(m.nv - 6), acceleration(Eigen::VectorXd::Zero(m.nv)) {}

    // a record: q (7 + N), v (6 + N), tau (6 + N), a (6 + N)
    Constant q(const double *r) const { return Constant(r, model.nq); }
    Constant v(const double *r) const { return Constant(r + model.nq, model.nv); }
    Constant tau(const double *r) const { return Constant(r + model.nq + model.nv, model.nv); }
    Constant a(const double *r) const { return Constant(r + model.nq + 2 * model.nv, model.nv); }
};

std::unique_ptr<Bench> bench;

bool numbers(std::FILE *file, double *out, int count)
{
    for (int i = 0; i < count; ++i) {
        if (std::fscanf(file, "%lf", out + i) != 1) { return false; }
    }
    return true;
}

} // namespace

extern "C" {

int peer_setup(const char *path)
{
    std::FILE *file = std::fopen(path, "r");
    double count = 0, given[25];
    if (file == nullptr || !numbers(file, &count, 1)) { return 1; }
    pin::Model model;
    model.gravity.setZero();
    for (int k = 0; k < static_cast<int>(count); ++k) {
        if (!numbers(file, given, 25)) { return 1; }
        using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
        const pin::SE3 place(Eigen::Map<const Rows>(given), Eigen::Map<const Eigen::Vector3d>(given + 9));
        const pin::Inertia inertia(given[12], Eigen::Map<const Eigen::Vector3d>(given + 13),
                                   Eigen::Map<const Rows>(given + 16));
        const std::string name = "body" + std::to_string(k);
        const auto joint = k == 0 ? model.addJoint(0, pin::JointModelFreeFlyer(), place, name)
                                  : model.addJoint(1, pin::JointModelRX(), place, name);
        model.appendBodyToJoint(joint, inertia, pin::SE3::Identity());
    }
    std::fclose(file);
    bench = std::make_unique<Bench>(model);
    return 0;
}

int peer_size(void) { return bench->model.nq + 3 * bench->model.nv; }
int peer_V(void) { return bench->model.nq; }
int peer_phi(void) { return 7; }

void peer_pack(const double *flat, double *record)
{
    const int n = bench->flywheels, nq = bench->model.nq, nv = bench->model.nv;
    Eigen::Map<Eigen::VectorXd> r(record, peer_size());
    const Constant f(flat, 12 + 4 * n);
    r.setZero();
    r[6] = 1.0; // quaternion, w last
    r.segment(7, n) = f.segment(6, n);
    r.segment(nq, 6) = f.head(6);
    r.segment(nq + 6, n) = f.segment(6 + n, n);
    r.segment(nq + nv + 6, n) = f.segment(6 + 3 * n, n);
    r.segment(nq + 2 * nv, 6) = f.tail(6);
    r.segment(nq + 2 * nv + 6, n) = f.segment(6 + 2 * n, n);
}

void peer_forward(const double *record, double *out)
{
    bench->acceleration.tail(bench->flywheels) = bench->a(record).tail(bench->flywheels);
    pin::crba(bench->model, bench->data, bench->q(record));
    pin::rnea(bench->model, bench->data, bench->q(record), bench->v(record), bench->acceleration);
    Matrix6 K = bench->data.M.topLeftCorner<6, 6>();
    K.triangularView<Eigen::StrictlyLower>() = K.transpose();
    const Eigen::LDLT<Matrix6> factors(K);
    Eigen::Map<Vector6>(out, 6) = factors.solve(-bench->data.tau.head<6>());
}

void peer_coupled(const double *record, double *out)
{
    Eigen::Map<Eigen::VectorXd>(out, bench->model.nv) =
        pin::aba(bench->model, bench->data, bench->q(record), bench->v(record), bench->tau(record));
}

void peer_torque(const double *record, double *out)
{
    pin::rnea(bench->model, bench->data, bench->q(record), bench->v(record), bench->a(record));
    Eigen::Map<Eigen::VectorXd>(out, bench->flywheels) = bench->data.tau.tail(bench->flywheels);
}

// By columns: of (V*, phi'') by V; by phi; by phi'; by tau.
void peer_coupled_jacobian(const double *record, double *out)
{
    const int n = bench->flywheels, nv = bench->model.nv;
    pin::computeABADerivatives(bench->model, bench->data, bench->q(record), bench->v(record), bench->tau(record));
    pin::Data &d = bench->data;
    d.Minv.triangularView<Eigen::StrictlyLower>() = d.Minv.transpose();
    Eigen::Map<Eigen::MatrixXd> slopes(out, nv, 6 + 3 * n);
    slopes.leftCols(6) = d.ddq_dv.leftCols(6);
    slopes.middleCols(6, n) = d.ddq_dq.rightCols(n);
    slopes.middleCols(6 + n, n) = d.ddq_dv.rightCols(n);
    slopes.rightCols(n) = d.Minv.rightCols(n);
}

} // extern "C"
