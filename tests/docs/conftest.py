# SPDX-License-Identifier: GPL-3.0-or-later
"""The tools of docs/ on the path, as its own scripts have them."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs" / "tools"))
