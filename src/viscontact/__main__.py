"""``python -m viscontact`` is the command ``viscontact``."""

import sys

from viscontact.cli import main

sys.exit(main())
