"""``python -m golc`` is ``golc``."""

from golc.cli import main

if __name__ == "__main__":
    main()
