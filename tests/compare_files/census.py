# SPDX-License-Identifier: GPL-3.0-or-later
"""Which shading nodes a file's picture needs, and which of them the engine has.

A node instance counts where it is reached from the output of a material, world or lamp that is used: once for each
place that a group is put in. Groups themselves, reroutes, frames and outputs are structure and do not count; muted
nodes are passed through. `docs/nodes.md` says which types are the same as in Cycles, which are approximated; others
are missing.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

ROW = re.compile(r"^\| `(\w+)` \| ([\w ]+?) \|", re.MULTILINE)


def states(table: Path) -> dict[str, str]:
    """Node type to "same" or "approximated", from the generated table of docs/nodes.md."""
    return {kind: state for kind, state in ROW.findall(table.read_text()) if not state.startswith("not")}


def shares(counts: dict[str, int], known: dict[str, str]) -> tuple[int, int, int, dict[str, int]]:
    """Instances in all, of types that the engine has, of those that are the same; and the missing types' counts."""
    total = sum(counts.values())
    missing = {kind: n for kind, n in counts.items() if kind not in known}
    same = sum(n for kind, n in counts.items() if known.get(kind) == "same")
    return total, total - sum(missing.values()), same, missing


def count(owners) -> Counter:
    """Node types that the trees of these materials, worlds and lamps reach."""
    found: Counter = Counter()
    for owner in owners:
        tree = owner.node_tree if getattr(owner, "use_nodes", False) else None
        output = tree.get_output_node("CYCLES") if tree else None
        if output is not None:
            _Walk(found).run(output)
    return found


class _Walk:
    """From sockets back along the links. A place is the chain of group nodes that leads to a tree."""

    def __init__(self, found: Counter) -> None:
        self._found, self._seen, self._links = found, set(), {}

    def run(self, output) -> None:
        waiting = [(socket, ()) for socket in output.inputs]
        while waiting:
            socket, place = waiting.pop()
            for link in self._incoming(socket):
                waiting += self._behind(link.from_node, link.from_socket, place)

    def _incoming(self, socket) -> list:
        tree = socket.id_data
        if tree.as_pointer() not in self._links:
            links: dict = {}
            for link in tree.links:
                if link.is_valid and not link.is_muted:
                    links.setdefault(link.to_socket.as_pointer(), []).append(link)
            self._links[tree.as_pointer()] = links
        return self._links[tree.as_pointer()].get(socket.as_pointer(), [])

    def _behind(self, node, socket, place: tuple) -> list:
        """The sockets to go on from."""
        key = (tuple(g.as_pointer() for g in place), socket.as_pointer())
        if key in self._seen:
            return []
        self._seen.add(key)
        if node.type == "REROUTE":
            return [(node.inputs[0], place)]
        if node.mute:
            return [(i.from_socket, place) for i in node.internal_links if i.to_socket == socket]
        if node.type == "GROUP":
            return self._enter(node, socket, place)
        if node.type == "GROUP_INPUT":
            outside = [i for i in place[-1].inputs if i.identifier == socket.identifier] if place else []
            return [(i, place[:-1]) for i in outside]
        here = (key[0], node.as_pointer())
        if here in self._seen:
            return []
        self._seen.add(here)
        self._found[node.bl_idname] += 1
        return [(i, place) for i in node.inputs]

    @staticmethod
    def _enter(node, socket, place: tuple) -> list:
        tree = node.node_tree
        if tree is None or any(g.node_tree == tree for g in place):
            return []
        ends = [n for n in tree.nodes if n.type == "GROUP_OUTPUT" and n.is_active_output]
        return [(i, (*place, node)) for n in ends for i in n.inputs if i.identifier == socket.identifier]
