/* As much of Simulink's header as an S-function of one input, two outputs and a sample time needs. */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H

typedef int int_T;
typedef double mxArray;

typedef struct SimStruct {
    const mxArray *parameters[2];
    double *input;
    double *output[2];
    int widths[3];
    double sample_time;
    void *work;
    const char *error;
} SimStruct;

#define mxGetScalar(array) (*(array))
#define ssGetSFcnParam(S, i) ((S)->parameters[i])
#define ssSetNumSFcnParams(S, n) ((void)(S))
#define ssGetNumSFcnParams(S) ((void)(S), 2)
#define ssGetSFcnParamsCount(S) ((void)(S), 2)
#define ssSetNumInputPorts(S, n) ((void)(S), (n) == 1)
#define ssSetNumOutputPorts(S, n) ((void)(S), (n) == 2)
#define ssSetInputPortWidth(S, i, n) ((S)->widths[i] = (n))
#define ssSetInputPortRequiredContiguous(S, i, on) ((void)(S))
#define ssSetInputPortDirectFeedThrough(S, i, on) ((void)(S))
#define ssSetOutputPortWidth(S, i, n) ((S)->widths[1 + (i)] = (n))
#define ssSetNumSampleTimes(S, n) ((void)(S))
#define ssSetNumPWork(S, n) ((void)(S))
#define ssSetSampleTime(S, i, t) ((S)->sample_time = (t))
#define ssSetOffsetTime(S, i, t) ((void)(S))
#define ssSetPWorkValue(S, i, p) ((S)->work = (p))
#define ssGetPWorkValue(S, i) ((S)->work)
#define ssSetErrorStatus(S, text) ((S)->error = (text))
#define ssGetInputPortRealSignal(S, i) ((const double *)(S)->input)
#define ssGetOutputPortRealSignal(S, i) ((S)->output[i])

#endif
