# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the repository's root importable, as `python -m bench` does."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
