/* Runs a command and prints what it took: seconds, and the most memory of one of its processes in kB.
 * A process of its own, since the system counts to a child the memory that its parent had when it was made. */
#define _DEFAULT_SOURCE
#include <stdio.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    struct timeval start, end;
    struct rusage  usage;
    int            status = 0;
    pid_t          child;

    if (argc < 2) { return 2; }
    gettimeofday(&start, NULL);
    child = fork();
    if (child == 0) {
        execvp(argv[1], argv + 1);
        _exit(127);
    }
    if (child < 0 || wait4(child, &status, 0, &usage) < 0) { return 2; }
    gettimeofday(&end, NULL);
    printf("%.6f %ld\n", (double)(end.tv_sec - start.tv_sec) + 1e-6 * (double)(end.tv_usec - start.tv_usec),
           usage.ru_maxrss);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
