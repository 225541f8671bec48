"""`mahovik` and `python -m mahovik`: the command line."""

import sys


def run() -> None:
    """Runs it. Ctrl-C while it is still imported ends as everywhere else: one line, status 130."""
    try:
        from mahovik.cli import main

        main()
    except KeyboardInterrupt:
        sys.stderr.write("error: interrupted; no file is half written\n")
        sys.exit(130)


if __name__ == "__main__":
    run()
