# SPDX-License-Identifier: GPL-3.0-or-later
"""A node tree as one flat graph: groups inlined, reroutes and muted nodes gone, only what reaches the output."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from . import conversions, nodes, sockets
from .image import Images


@dataclass(eq=False)
class _Place:
    """A node tree at one place: the same group may be inlined many times. `incoming`: link by target socket."""

    tree: Any
    group: Any = None
    parent: _Place | None = None

    def __post_init__(self) -> None:
        self.key = self.tree.as_pointer()
        self.children: dict[int, _Place | None] = {}
        self.incoming = {link.to_socket.as_pointer(): link for link in self.tree.links
                         if link.is_valid and not link.is_muted}

    def contains(self, tree_key: int) -> bool:
        return self.key == tree_key or (self.parent is not None and self.parent.contains(tree_key))


class GraphWalk:
    """One use: `GraphWalk(tree, …).run()`."""

    def __init__(self, owner: str, tree: Any, images: Images, warn: Callable[[str], None],
                 layer_value: Callable[[str], list[float]] | None = None) -> None:
        """layer_value: what an Attribute node of type View Layer reads by a name; None: its value is left out."""
        self._owner, self._images, self._warn, self._layer_value = owner, images, warn, layer_value
        self._root = _Place(tree)
        self._nodes: list[dict[str, Any]] = []
        self._index: dict[tuple[int, int], int] = {}
        self._open: list[tuple[int, Any, _Place]] = []  # nodes whose inputs are still to be followed

    def run(self) -> dict[str, Any]:
        """The dictionary of docs/python-api.md; without a surface when there is no active output."""
        graph: dict[str, Any] = {"nodes": self._nodes, "surface": None, "volume": None, "displacement": None}
        output, place = self._output(self._root)
        if output is None:
            self._warn(f"{self._owner}: the node tree has no active output")
            return self._never_empty(graph)
        for socket in output.inputs:
            slot = socket.identifier.lower()
            if slot in graph:
                found = self._resolve(socket, place)
                graph[slot] = [found["node"], found["socket"]] if isinstance(found, dict) else None
        while self._open:
            index, node, place = self._open.pop()
            self._nodes[index]["inputs"] = self._inputs(node, place)
        return self._never_empty(graph)

    def _output(self, place: _Place) -> tuple[Any, _Place]:
        """The active output and where it stands: Cycles takes one inside a group too."""
        output = place.tree.get_output_node("CYCLES")
        if output is not None:
            return output, place
        for node in place.tree.nodes:
            if node.type == "GROUP" and not node.mute and node.node_tree is not None:
                inside = self._child(node, place)
                if inside is not None:
                    output, found = self._output(inside)
                    if output is not None:
                        return output, found
        return None, place

    def _never_empty(self, graph: dict[str, Any]) -> dict[str, Any]:
        """A tree without a shader is black; a graph without nodes would stand for a material without a tree."""
        if not self._nodes:
            self._nodes.append({"name": "no shader", "type": "ShaderNodeValue", "params": {}, "inputs": {}})
        return graph

    def _inputs(self, node: Any, place: _Place) -> dict[str, Any]:
        found = {}
        for socket in node.inputs:
            if socket.is_unavailable:
                continue
            value = self._resolve(socket, place)
            if value is not None:
                found[socket.identifier] = value
        return found

    def _resolve(self, target: Any, place: _Place) -> Any:
        """What arrives at the input `target`: a link dictionary, a value, or None."""
        socket, seen, passed = target, set(), []
        while True:
            key = (id(place), socket.as_pointer())
            link = place.incoming.get(key[1])
            if link is None:
                return self._value(self._unlinked(socket), passed, target)
            if key in seen:
                self._warn(f"{self._owner}: a loop of links is ignored")
                return self._value(sockets.own_value(target), [], target)
            seen.add(key)
            step = self._step(link.from_node, link.from_socket, place)
            if step is None:
                return self._value(sockets.own_value(target), [], target)
            if isinstance(step, dict):
                return conversions.along(step, passed[::-1], self._append)
            if isinstance(step, str):
                return self._value(sockets.zero(step), [*passed, step], target)
            socket, place = step
            passed.append(socket.type)

    @staticmethod
    def _unlinked(socket: Any) -> Any:
        return sockets.zero(socket.type) if socket.node.type == "REROUTE" else sockets.own_value(socket)

    @staticmethod
    def _value(value: Any, passed: list[str], target: Any) -> Any:
        """A constant from the far end of `passed` (target side first), as `target` sees it."""
        if sockets.is_geometric(target):
            return None
        kinds = [*passed[::-1], target.type]
        for source, kind in pairwise(kinds):
            value = sockets.convert(value, source, kind)
        return value

    def _step(self, node: Any, output: Any, place: _Place) -> Any:
        """Backwards through one node: (input, place) to go on from, a link, a socket type (zero), or None (no link)."""
        if node.type == "REROUTE":
            return node.inputs[0], place
        if node.mute:
            inner = next((i for i in node.internal_links if i.to_socket == output), None)
            return (inner.from_socket, place) if inner else None
        if node.bl_idname == "NodeUndefined":
            self._warn(f"{self._owner}: node “{node.name}” is of a type that this Blender does not know, it is ignored")
            return None
        if node.type in ("GROUP", "CUSTOM GROUP"):
            return self._into_group(node, output, place)
        if node.type == "GROUP_INPUT":
            return self._out_of_group(output, place)
        if output.is_unavailable:
            return None
        return {"node": self._add(node, place), "socket": output.identifier, "type": output.type}

    def _into_group(self, node: Any, output: Any, place: _Place) -> Any:
        inside = self._child(node, place)
        if inside is None:
            return output.type
        end = next((n for n in inside.tree.nodes if n.type == "GROUP_OUTPUT" and n.is_active_output), None)
        socket = _by_identifier(end.inputs, output.identifier) if end else None
        return (socket, inside) if socket else output.type

    def _out_of_group(self, output: Any, place: _Place) -> Any:
        if place.parent is None:
            return output.type
        socket = _by_identifier(place.group.inputs, output.identifier)
        return (socket, place.parent) if socket else output.type

    def _child(self, node: Any, place: _Place) -> _Place | None:
        key = node.as_pointer()
        if key not in place.children:
            place.children[key] = self._enter(node, place)
        return place.children[key]

    def _enter(self, node: Any, place: _Place) -> _Place | None:
        tree = node.node_tree
        if tree is None:
            self._warn(f"{self._owner}: group node “{node.name}” has no group")
            return None
        if place.contains(tree.as_pointer()):
            self._warn(f"{self._owner}: group “{tree.name}” contains itself, the inner one is ignored")
            return None
        return _Place(tree, node, place)

    def _add(self, node: Any, place: _Place) -> int:
        key = (id(place), node.as_pointer())
        if key not in self._index:
            self._index[key] = len(self._nodes)
            self._append({"name": node.label or node.name, "type": node.bl_idname,
                          "params": self._params(node), "inputs": {}})
            self._open.append((self._index[key], node, place))
        return self._index[key]

    def _params(self, node: Any) -> dict[str, Any]:
        found = nodes.params(node, self._images)
        if node.bl_idname == "ShaderNodeAttribute" and node.attribute_type == "VIEW_LAYER" and self._layer_value:
            found["value"] = self._layer_value(node.attribute_name)
        return found

    def _append(self, node: dict[str, Any]) -> int:
        self._nodes.append(node)
        return len(self._nodes) - 1


def _by_identifier(collection: Any, identifier: str) -> Any:
    return next((s for s in collection if s.identifier == identifier), None)
