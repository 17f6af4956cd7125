# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of the comparison with Cycles; importing the package fills kit.CASES."""

from . import bsdfs, geometry, lamps, lights, settings, textures, view  # noqa: F401
