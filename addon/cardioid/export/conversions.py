# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversions that a link undergoes on its way through sockets of groups and reroutes.

A colour that enters a group through a number socket is grey inside. The engine converts once, from the type of the
source to that of the input, so a detour through a number becomes a node of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from . import sockets

_DOT = {"name": "Average", "type": "ShaderNodeVectorMath", "output": "Value", "input": "Vector",
        "params": {"operation": "DOT_PRODUCT"}, "inputs": {"Vector_001": [1 / 3, 1 / 3, 1 / 3]}}
_GREY = {"name": "Grey", "type": "ShaderNodeRGBToBW", "output": "Val", "input": "Color", "params": {}, "inputs": {}}


def along(link: dict[str, Any], passed: list[str], add: Callable[[dict[str, Any]], int]) -> dict[str, Any]:
    """`link` after sockets of the types `passed`, source first; `add` appends a node and returns its index."""
    for kind in passed:
        link = _step(link, kind, add)
    return link


def _step(link: dict[str, Any], kind: str, add: Callable[[dict[str, Any]], int]) -> dict[str, Any]:
    source = link["type"]
    if source == kind or sockets.is_number(source):
        return link  # a number spreads over all components wherever that happens
    if sockets.is_number(kind):
        node = _GREY if source == "RGBA" else _DOT
        index = add({"name": node["name"], "type": node["type"], "params": dict(node["params"]),
                     "inputs": {**node["inputs"], node["input"]: link}})
        return {"node": index, "socket": node["output"], "type": "VALUE"}
    return {**link, "type": kind} if {source, kind} == {"RGBA", "VECTOR"} else link
