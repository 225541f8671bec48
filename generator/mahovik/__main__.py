"""`python -m mahovik`: the command line."""

from mahovik.cli import main

if __name__ == "__main__":
    main()
