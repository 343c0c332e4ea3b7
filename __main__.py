"""The command `textmech` as `python -m textmech`, where scripts are on no path."""

from .reports.front.start import main

if __name__ == "__main__":
    main()
