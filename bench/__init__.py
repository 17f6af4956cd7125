# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures Cardioid beside other engines: error, energy and CPU seconds together. Run by `./scripts/bench`."""
