# SPDX-License-Identifier: GPL-3.0-or-later
"""One HTML page, and the docs' gallery, from what the bench found."""
