# SPDX-License-Identifier: GPL-3.0-or-later
"""Other renderers on the thesis's three scenes: scenes, what runs inside each renderer, references."""
