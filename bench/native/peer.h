/* What every compiled peer offers to the harness: one shared library a peer, build and stand.
 *
 * A record holds a state with its inputs as the peer itself keeps them, so that no call pays for a conversion.
 * Flat input: V[6], phi[N], phi_dot[N], phi_ddot[N], tau[N], V_dot[6]; position 0, attitude 1. SI, axes of E1.
 * Works, each where the peer has it: void peer_WORK(const double *record, double *out), with
 *   forward -> V_dot[6];  coupled -> V_dot[6], phi_ddot[N];  torque -> tau[N];  see works.py for the others. */
#ifndef PEER_H
#define PEER_H

#ifdef __cplusplus
extern "C" {
#endif

int  peer_setup(const char *path);                       /* reads the model where the peer needs one; 0: good */
int  peer_size(void);                                    /* doubles in a record */
int  peer_V(void);                                       /* where V begins in a record */
int  peer_phi(void);                                     /* where phi begins */
void peer_pack(const double *flat, double *record);      /* a record of flat input */

#ifdef __cplusplus
}
#endif

#endif
