// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that several translators share.
#pragma once

#include "nodes/node_context.h"

namespace cardioid::nodes {

inline Ref3 rows3(const Results& r) { return {r[0], r[1], r[2]}; }

inline Ref3 instance3(NodeContext& c, InstanceValue value) {
    return rows3(c.b.emit_all(Op::instance_value, {}, static_cast<std::uint32_t>(value)));
}

inline Ref ray_value(NodeContext& c, RayValue v) { return c.b.emit(Op::ray_value, {}, static_cast<std::uint32_t>(v)); }

/// Object space to world space.
inline Ref3 to_world(NodeContext& c, Ref3 v, Quantity quantity) {
    return c.b.emit3(Op::transform, {v.x, v.y, v.z}, transform_mode(Space::object, quantity, Direction::to_world));
}
inline Ref3 to_object(NodeContext& c, Ref3 v, Quantity quantity) {
    return c.b.emit3(Op::transform, {v.x, v.y, v.z}, transform_mode(Space::object, quantity, Direction::from_world));
}

/// Relative index for the side that wo is on.
inline Ref sided_eta(NodeContext& c, Ref ior) {
    const Ref eta = c.b.maximum(ior, c.b.constant(1e-5f));
    return c.b.select_positive(c.b.chunk(ChunkRow::backfacing), c.b.divide(c.b.constant(1), eta), eta);
}

/// The part of an object-space direction that lies in the surface.
inline Ref3 tangent_around(NodeContext& c, Ref3 around) {
    const Ref3 t = c.b.emit3(Op::transform, {around.x, around.y, around.z},
                             transform_mode(Space::object, Quantity::normal, Direction::to_world));
    const Ref3 n = c.normal();
    return c.b.cross(n, c.b.normalize(c.b.cross(t, n)));
}

/// Blender's tangent of a surface without one: around the z axis of the generated coordinates.
inline Ref3 default_tangent(NodeContext& c) {
    const Ref3 g = c.generated();
    const Ref half = c.b.constant(0.5f);
    return tangent_around(c, {c.b.subtract(half, g.y), c.b.subtract(g.x, half), c.b.constant(0)});
}

/// The normal tilted by a height that changes by dx and dy over the two steps.
inline Ref3 tilted(NodeContext& c, Ref3 n, Ref3 sx, Ref3 sy, Ref dx, Ref dy, Ref strength, Ref distance) {
    return c.b.emit3(Op::bump, {n.x, n.y, n.z, sx.x, sx.y, sx.z, sy.x, sy.y, sy.z, dx, dy, strength, distance});
}
inline Ref3 bumped(NodeContext& c, Ref3 n, Ref dx, Ref dy, Ref strength, Ref distance) {
    return tilted(c, n, c.step(Shift::x), c.step(Shift::y), dx, dy, strength, distance);
}
/// The same in object space, with the steps that the position makes.
Ref3 bumped_in_object_space(NodeContext& c, Ref3 n, Ref dx, Ref dy, Ref strength, Ref distance);

/// `v` turned about the unit `axis` by `angle` radians.
inline Ref3 rotated(NodeContext& c, Ref3 v, Ref3 axis, Ref angle) {
    return c.b.emit3(Op::rotate, {v.x, v.y, v.z, axis.x, axis.y, axis.z, angle});
}

/// Tangent input of a glossy node, turned about the normal; `rotation` counts whole turns.
inline Ref3 rotated_tangent(NodeContext& c, Ref3 normal, const char* tangent, const char* rotation) {
    const Ref3 t = c.linked(tangent) ? c.vector(tangent) : default_tangent(c);
    const Ref turns = c.number(rotation, 0);
    return c.b.is(turns, 0) ? t : rotated(c, t, normal, c.b.multiply(turns, c.b.constant(6.2831853f)));
}

/// Principled's stretch of alpha.
inline void anisotropic_alpha(NodeContext& c, Ref alpha, Ref anisotropic, GgxLobe& lobe) {
    const Ref aspect = c.b.emit(Op::square_root, {c.b.one_minus(c.b.multiply(anisotropic, c.b.constant(0.9f)))});
    lobe.alpha_x = c.b.divide(alpha, aspect);
    lobe.alpha_y = c.b.multiply(alpha, aspect);
}

/// Thin Film sockets, for nodes that have them.
inline void set_film(NodeContext& c, GgxLobe& l, bool glass = false, Ref inside = {}) {
    l.film_thickness = c.b.maximum(c.number("Thin Film Thickness", 0), c.b.constant(0));
    if (c.b.is(l.film_thickness, 0)) return;
    l.film_ior = c.b.maximum(c.number("Thin Film IOR", 1.33f), c.b.constant(1e-5f));
    if (glass) {
        // Seen from inside, the film's index counts from the glass.
        const Ref back = c.b.chunk(ChunkRow::backfacing);
        l.film_ior = c.b.select_positive(back, c.b.divide(l.film_ior, inside), l.film_ior);
    }
}

enum class TextureDefault { generated, uv, position };
/// The "Vector" of a texture node, through its old mapping panel; unlinked: the default coordinates.
Ref3 texture_point(NodeContext& c, TextureDefault unlinked);

/// The render-active UV map, z 0.
inline Ref3 active_uv(NodeContext& c) {
    const Results r = c.attribute(k_active_uv);
    return {r[0], r[1], c.b.constant(0)};
}

/// a·v + translation with a constant matrix.
Ref3 constant_affine(NodeContext& c, const Affine& a, Ref3 v, bool translate);

/// Colour of a black body, luminance 1, as the Blackbody node gives it.
Ref3 blackbody_color(NodeContext& c, Ref temperature);

/// Fresnel reflectance of a dielectric for the cosine of incidence.
inline Ref fresnel(NodeContext& c, Ref cosine, Ref eta) { return c.b.emit(Op::fresnel, {cosine, eta}); }

}  // namespace cardioid::nodes
