/* In the place of Simulink's: a program that runs the block. Arguments: sample time, dt, samples, then the inputs. */
#include <stdio.h>

int main(int count, char **words)
{
    double parameters[2], input[64] = { 0 }, output[2][512] = { { 0 } };
    SimStruct S = { { &parameters[0], &parameters[1] }, input, { output[0], output[1] }, { 0 }, 0.0, NULL, NULL };
    int i, k;

    for (i = 0; i < 2; ++i) { parameters[i] = strtod(words[1 + i], NULL); }
    for (i = 4; i < count; ++i) { input[i - 4] = strtod(words[i], NULL); }
    mdlInitializeSizes(&S);
    mdlInitializeSampleTimes(&S);
    mdlStart(&S);
    for (k = 0; k <= atoi(words[3]) && !S.error; ++k) {
        mdlOutputs(&S, 0);
        for (i = 0; i < S.widths[1]; ++i) { printf("%.17g ", output[0][i]); }
        printf("\n");
        mdlUpdate(&S, 0);
    }
    mdlTerminate(&S);
    if (S.error) { printf("%s\n", S.error); }  /* when the block is gone */
    return 0;
}
