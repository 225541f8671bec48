#!/bin/sh
# auv6_eva.sh: what Frama-C Eva proves of auv6.c, driver by driver. Needs frama-c (Debian: frama-c-base).
# mahovik 0.1.0; structure 192ea446, physics 002b2abc. Generated: change the stand file instead.
#
# sh auv6_eva.sh             all that is claimed; exit status 1 where anything is not proved
# sh auv6_eva.sh tried       the other functions: what is not proved of them is printed, and is no error
# sh auv6_eva.sh any_forward ...  these drivers; see auv6_eva.c
# EVA_LOGS=DIR keeps the output of Frama-C. One line per driver: name, alarms, unproved properties of its results, seconds.
set -u
cd "$(dirname "$0")" || exit 2
command -v frama-c >/dev/null || { echo "no frama-c: on Debian, apt-get install frama-c-base" >&2; exit 2; }
logs=${EVA_LOGS:-$(mktemp -d)} || exit 2
failed=0

claimed="normal_forward any_forward bits_forward normal_momentum any_momentum normal_torque any_torque normal_coupled any_coupled bits_step normal_wrap any_wrap bits_wrap normal_prepare bits_prepare routine_sincos routine_sqrt routine_check_state"
tried="normal_matrices any_matrices bits_matrices bits_momentum bits_torque bits_coupled normal_step any_step normal_step_driven any_step_driven bits_step_driven normal_phase_of_counts any_phase_of_counts bits_phase_of_counts normal_speed_of_counts any_speed_of_counts bits_speed_of_counts normal_accumulate any_accumulate bits_accumulate normal_forward_jacobian any_forward_jacobian bits_forward_jacobian normal_coupled_jacobian any_coupled_jacobian bits_coupled_jacobian normal_inverse any_inverse bits_inverse normal_inverse_fast any_inverse_fast bits_inverse_fast normal_points any_points bits_points normal_quaternion any_quaternion bits_quaternion normal_state_from_coordinates any_state_from_coordinates bits_state_from_coordinates normal_generalized any_generalized bits_generalized any_prepare normal_mounts any_mounts bits_mounts normal_prepare_mounts any_prepare_mounts bits_prepare_mounts normal_step_carried any_step_carried bits_step_carried normal_step_driven_carried any_step_driven_carried bits_step_driven_carried"

# Checks are followed path by path (slevel, split-return), arithmetic is not: the paths would multiply. A status that
# tells of a result, COARSE, is kept apart from those of a refusal, which leaves results untouched.
split="auv6_within:0,auv6_check_state:0,auv6_factor3:0,auv6_factor_carrier:0,auv6_accelerate:0,auv6_factor_schur:0,auv6_solve_coupled:0,auv6_finish:0,auv6_rate:0,auv6_stages:0,auv6_rate_driven:0,auv6_stages_driven:0,auv6_factor:0,auv6_demand:0,auv6_frame_of_axes:0,auv6_check_inertia:0,auv6_check_body:0,auv6_check_dry_body:0,auv6_place_flywheel:0,auv6_check_added_mass:0,auv6_translation_block:0,auv6_check_parameters:0,auv6_finish_carried:0,auv6_forward:0:32,auv6_matrices:0:32,auv6_momentum:0:32,auv6_torque:0:32,auv6_coupled:0:32,auv6_step:0:32,auv6_step_driven:0:32,auv6_wrap:0:32,auv6_phase_of_counts:0:32,auv6_speed_of_counts:0:32,auv6_accumulate:0:32,auv6_forward_jacobian:0:32,auv6_coupled_jacobian:0:32,auv6_inverse:0:32,auv6_inverse_fast:0:32,auv6_points:0:32,auv6_quaternion:0:32,auv6_state_from_coordinates:0:32,auv6_generalized:0:32,auv6_prepare:0:32,auv6_mounts:0:32,auv6_prepare_mounts:0:32,auv6_step_carried:0:32,auv6_step_driven_carried:0:32,quaternion:full,one_of_all:full,one_beyond:full,normal_state:full,any_state:full,bits_state:full,normal_encoder:full,any_encoder:full,bits_encoder:full,normal_inverse_options:full,any_inverse_options:full,bits_inverse_options:full,normal_parameters:full,any_parameters:full,bits_parameters:full,normal_step_carry:full,any_step_carry:full,bits_step_carry:full"
merged="auv6_sincos:0,auv6_sqrt:0,auv6_unwound:0,auv6_wrapped:0,auv6_rotation:0,auv6_rotate_back:0,auv6_sincos_each:0,auv6_sum_mass:0,auv6_sum_steady_spin:0,auv6_sum_spin:0,auv6_damp:0,auv6_external:0,auv6_momentum_screw:0,auv6_subtract_rates:0,auv6_solve3:0,auv6_solve_carrier:0,auv6_velocity_matrix:0,auv6_couple:0,auv6_eliminate:0,auv6_balance:0,auv6_solve_schur:0,auv6_solve_coupled:0,auv6_advance:0,auv6_damp_by_V:0,auv6_external_by_V:0,auv6_twist_slope:0,auv6_row_slope:0,auv6_orthogonalise:0,auv6_solve_gram:0,auv6_allocate:0,auv6_motor_lacks:0,auv6_excessive:0,auv6_sense:0,auv6_products:0,auv6_carry:0,auv6_check_inertia:0,auv6_carry_twist:0,auv6_mount_wrench:0,auv6_advance_carried:0"

prove() {
    case $1 in
    normal_* | any_*) special=non-finite asked='check|precondition.*' ;;
    *) special=none asked=check ;;  # a contract that the body is not shown to keep is no fault of the driver
    esac
    begun=$(date +%s)
    set -- "$1" "-cpp-extra-args=-I. -DAUV6_PLAIN_NAMES" -machdep x86_64 -no-unicode \
        -eva -eva-precision 3 -eva-min-loop-unroll 25 -eva-slevel 4000 -eva-slevel-function "$merged" -eva-split-return-function "$split" \
        -warn-special-float "$special" -eva-msg-key=-initial-state,-final-states -main "auv6_eva_$1"
    case $1 in
    routine_check_*) set -- "$@" -cpp-extra-args=-DAUV6_EVA_BODIES -eva-subdivide-non-linear 4 ;;  # a square is not below zero
    routine_* | bits_*) ;;
    *) set -- "$@" -eva-use-spec "auv6_sincos,auv6_sincos_each,auv6_check_state" \
        -eva-builtin "auv6_sqrt:Frama_C_sqrt" ;;
    esac
    driver=$1
    shift
    ${EVA_LIMIT:+timeout "$EVA_LIMIT"} frama-c "$@" auv6_eva.c >"$logs/$driver.log" 2>&1
    ended=$?
    alarms=$(sed -n 's/^ *\([0-9]*\) alarms\{0,1\} generated.*/\1/p' "$logs/$driver.log")
    unproved=$(grep -c -E "($asked) got status (unknown|invalid)" "$logs/$driver.log")
    # A driver that never comes back from the function has proved nothing.
    if [ "$ended" -ne 0 ] || [ -z "$alarms" ] || ! grep -q 'show_each_returned' "$logs/$driver.log"; then
        alarms=failed
    fi
    echo "$driver alarms $alarms unproved $unproved seconds $(($(date +%s) - begun))"
    [ "$alarms $unproved" = "0 0" ] || failed=1
}

case ${1-} in
"") for driver in $claimed; do prove "$driver"; done ;;
tried)
    for driver in $tried; do prove "$driver"; done
    failed=0
    ;;
*) for driver in "$@"; do prove "$driver"; done ;;
esac
[ -n "${EVA_LOGS-}" ] || rm -rf "$logs"
exit $failed
