// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/node_context.h"

#include <algorithm>

namespace cardioid::nodes {

const scene::InputDesc* NodeContext::input(const char* id) const {
    const auto it = node.inputs.find(id);
    return it == node.inputs.end() ? nullptr : &it->second;
}

const Value* NodeContext::source(const char* id) const {
    const scene::InputDesc* in = input(id);
    if (in == nullptr || !in->linked()) return nullptr;
    if (compiler_.is_closure(in->node)) {
        compiler_.warn(compiler_.context().name + "/closure",
                       place() + ": a shader is linked to '" + id + "', which takes a value");
        return nullptr;
    }
    return compiler_.output(in->node, in->socket, shift_);
}

Ref NodeContext::number(const char* id, float fallback) {
    if (const Value* v = source(id)) {
        if (v->type == Value::Type::number) return v->v.x;
        return v->type == Value::Type::color ? b.luminance(v->v) : b.average(v->v);
    }
    const scene::InputDesc* in = input(id);
    return b.constant(in != nullptr && !in->linked() ? in->value[0] : fallback);
}

Ref3 NodeContext::vector(const char* id, Float3 fallback) {
    if (const Value* v = source(id)) return v->type == Value::Type::number ? b.broadcast(v->v.x) : v->v;
    const scene::InputDesc* in = input(id);
    return b.constant(in != nullptr && !in->linked() ? Float3{in->value[0], in->value[1], in->value[2]} : fallback);
}

Ref3 NodeContext::color(const char* id, Float3 fallback) { return vector(id, fallback); }

bool NodeContext::flag(const char* name, bool fallback) const {
    const auto it = node.params.find(name);
    if (it == node.params.end()) return fallback;
    if (const bool* v = std::get_if<bool>(&it->second)) return *v;
    if (const double* v = std::get_if<double>(&it->second)) return *v != 0;
    return fallback;
}

double NodeContext::property(const char* name, double fallback) const {
    const auto it = node.params.find(name);
    if (it == node.params.end()) return fallback;
    if (const double* v = std::get_if<double>(&it->second)) return *v;
    if (const bool* v = std::get_if<bool>(&it->second)) return *v ? 1 : 0;
    return fallback;
}

std::string NodeContext::text(const char* name, const char* fallback) const {
    const auto it = node.params.find(name);
    if (it == node.params.end()) return fallback;
    const std::string* v = std::get_if<std::string>(&it->second);
    return v != nullptr ? *v : fallback;
}

std::vector<double> NodeContext::list(const char* name) const {
    const auto it = node.params.find(name);
    if (it == node.params.end()) return {};
    const auto* v = std::get_if<std::vector<double>>(&it->second);
    return v != nullptr ? *v : std::vector<double>{};
}

Ref3 NodeContext::step(Shift axis) {
    const Ref3 pixel = b.emit3(Op::surface_step, {}, axis == Shift::x ? 0u : 1u);
    return b.multiply(pixel, b.constant(compiler_.step()));
}

Ref3 NodeContext::undisplaced(Ref3 moved) {
    const Results r = attribute(k_undisplaced, attribute_missing_clear);
    const Ref3 p =
        b.emit3(Op::transform, {r[0], r[1], r[2]}, transform_mode(Space::object, Quantity::point, Direction::to_world));
    return Builder::each(p, moved, [&](Ref x, Ref y) { return b.select_positive(r[3], x, y); });
}

Ref3 NodeContext::position() {
    const Ref3 here = b.chunk3(ChunkRow::position);
    const Ref3 p = shift_ == Shift::none ? here : b.add(here, step(shift_));
    return compiler_.undisplaced_ ? undisplaced(p) : p;
}

Ref NodeContext::barycentric(int k) {
    const auto row = static_cast<std::uint32_t>(k);
    if (shift_ == Shift::none) return b.chunk(ChunkRow::barycentric_u, row);
    const Ref3 d = step(shift_);
    return b.emit_all(Op::barycentric_step, {d.x, d.y, d.z})[row];
}

Ref3 NodeContext::object_position() {
    const Ref3 p = position();
    if (kind() == GraphKind::world) return p;
    return b.emit3(Op::transform, {p.x, p.y, p.z},
                   transform_mode(Space::object, Quantity::point, Direction::from_world));
}

Ref3 NodeContext::generated() {
    Ref3 p = position();
    if (kind() == GraphKind::world) return p;
    if (shift_ != Shift::none) {
        // As any attribute of a triangle that is seen from behind (op barycentric_step).
        const Ref3 d = step(shift_);
        const Ref back = b.chunk(ChunkRow::backfacing), minus_two = b.constant(-2);
        p = b.add(p, b.multiply(d, b.multiply(back, minus_two)));
    }
    if (compiler_.moved_ && !compiler_.undisplaced_) p = undisplaced(p);
    const Ref3 box = b.emit3(Op::transform, {p.x, p.y, p.z},
                             transform_mode(Space::generated, Quantity::point, Direction::from_world));
    if (kind() != GraphKind::material) return box;
    const Results stored = attribute(k_generated, attribute_missing_clear);
    return Builder::each({stored[0], stored[1], stored[2]}, box,
                         [&](Ref x, Ref y) { return b.select_positive(stored[3], x, y); });
}

namespace {

/// Id of a name in a list that grows; -1 (as unsigned) without a list.
std::uint32_t id_in(std::vector<std::string>* names, const std::string& name) {
    if (names == nullptr) return 0xffffffffu;
    auto it = std::find(names->begin(), names->end(), name);
    if (it == names->end()) it = names->insert(names->end(), name);
    return static_cast<std::uint32_t>(it - names->begin());
}

}  // namespace

std::uint32_t NodeContext::attribute_id(const std::string& name) {
    return id_in(compiler_.context().attribute_names, name);
}

Results NodeContext::attribute(const std::string& name, std::uint32_t missing) {
    return b.emit_all(Op::attribute, {barycentric_u(), barycentric_v()}, attribute_id(name), missing);
}

Results NodeContext::instance_value(const std::string& name) {
    return b.emit_all(Op::named_value, {}, id_in(compiler_.context().instance_value_names, name));
}

Ref NodeContext::number_at(const char* id, Shift shift, float fallback) {
    const scene::InputDesc* in = input(id);
    if (in == nullptr || !in->linked() || compiler_.is_closure(in->node)) return number(id, fallback);
    if (compiler_.bump_depth_ >= GraphCompiler::k_max_bump_depth) return number(id, fallback);
    ++compiler_.bump_depth_;
    compiler_.evaluate(in->node, shift);
    --compiler_.bump_depth_;
    NodeContext other(compiler_, index_, shift, nullptr);
    return other.number(id, fallback);
}

void NodeContext::shader(const char* id, Ref weight) {
    const scene::InputDesc* in = input(id);
    if (in == nullptr || !in->linked()) return;
    if (compiler_.types_[static_cast<std::size_t>(in->node)] == nullptr) {
        in_volume() ? compiler_.name_unknown(in->node) : compiler_.unknown_surface(in->node, weight);
        return;
    }
    if (!compiler_.is_closure(in->node)) {
        // A value where a shader is expected is emission.
        if (source(id) != nullptr) emission(b.multiply(color(id), weight));
        return;
    }
    const auto n = static_cast<std::size_t>(in->node);
    compiler_.weight_[n] = b.add(compiler_.weight_[n], weight);
    compiler_.reached_[n] = true;
}

void NodeContext::emission(Ref3 radiance) { in_volume() ? b.medium_emission(radiance) : b.emission(radiance); }
void NodeContext::transparent(Ref3 weight) {
    if (!in_volume()) b.transparent(weight);
}
void NodeContext::holdout(Ref weight) {
    if (!in_volume()) b.holdout(weight);
}
void NodeContext::absorption(Ref3 coefficient) {
    if (in_volume()) b.medium_absorption(b.maximum(coefficient, b.constant(0)));
}
void NodeContext::scattering(PhaseKind phase, Ref3 coefficient, Ref3 parameter) {
    if (in_volume()) compiler_.add_phase(phase, b.maximum(coefficient, b.constant(0)), parameter, index_);
}

bool NodeContext::room_for_lobe(Ref3 weight) {
    if (in_volume() || kind() != GraphKind::material) return false;
    if (b.optimise() && b.is(weight, 0)) return false;
    if (compiler_.lobes_ < bsdf::k_max_lobes) {
        ++compiler_.lobes_;
        return true;
    }
    compiler_.warn(compiler_.context().name + "/lobes",
                   place() + ": the material has more BSDF layers than can be kept; this one is left out");
    return false;
}

void NodeContext::simple_lobe(bsdf::LobeKind lobe, Ref3 weight, Ref3 n, Ref roughness, bool preserve_energy,
                              Ref3 color_rows) {
    if (!room_for_lobe(weight)) return;
    const std::uint32_t imm =
        static_cast<std::uint32_t>(lobe) | lobe_keep | (preserve_energy ? lobe_preserve_energy : 0u);
    b.emit(Op::lobe_simple,
           {weight.x, weight.y, weight.z, n.x, n.y, n.z, roughness, color_rows.x, color_rows.y, color_rows.z}, imm);
}

GgxLobe NodeContext::ggx() {
    const Ref3 one = b.constant(Float3{1, 1, 1});
    GgxLobe l;
    l.weight = l.f0 = l.f90 = l.tint = l.layer_weight = one;
    l.normal = normal();
    l.tangent = b.constant(Float3{0, 0, 0});
    l.alpha_x = l.alpha_y = b.constant(0);
    l.eta = b.constant(1);
    l.film_thickness = b.constant(0);
    l.film_ior = b.constant(1.33f);
    return l;
}

Ref NodeContext::ggx_lobe(const GgxLobe& l) {
    if (!room_for_lobe(l.weight)) return b.constant(1);
    const std::uint32_t imm =
        static_cast<std::uint32_t>(l.kind) | static_cast<std::uint32_t>(l.fresnel) << lobe_fresnel_shift |
        static_cast<std::uint32_t>(l.distribution) << lobe_distribution_shift |
        (l.preserve_energy ? lobe_preserve_energy : 0u) | (l.separable_masking ? lobe_separable : 0u) |
        (l.walks_facets ? lobe_walks_facets : 0u) | (b.is(l.film_thickness, 0) ? 0u : lobe_thin_film);
    return b.emit(
        Op::lobe_ggx,
        {l.weight.x,       l.weight.y,       l.weight.z,       l.normal.x,       l.normal.y, l.normal.z, l.tangent.x,
         l.tangent.y,      l.tangent.z,      l.alpha_x,        l.alpha_y,        l.eta,      l.f0.x,     l.f0.y,
         l.f0.z,           l.f90.x,          l.f90.y,          l.f90.z,          l.tint.x,   l.tint.y,   l.tint.z,
         l.layer_weight.x, l.layer_weight.y, l.layer_weight.z, l.film_thickness, l.film_ior},
        imm);
}

void NodeContext::hair_lobe(const HairLobe& l) {
    if (!room_for_lobe(l.weight)) return;
    b.emit(Op::lobe_hair,
           {l.weight.x,  l.weight.y, l.weight.z, l.normal.x, l.normal.y, l.normal.z, l.tangent.x, l.tangent.y,
            l.tangent.z, l.alpha_x,  l.alpha_y,  l.third,    l.eta,      l.f0.x,     l.f0.y,      l.f0.z,
            l.f90.x,     l.f90.y,    l.f90.z,    l.tint.x,   l.tint.y,   l.tint.z},
           static_cast<std::uint32_t>(l.kind) | lobe_keep);
}

void NodeContext::subsurface_lobe(const SubsurfaceLobe& l, const std::string& method, bool before_4) {
    if (!room_for_lobe(l.weight)) return;
    using bsdf::Fresnel;
    const bool burley = method == "BURLEY";
    const bool skin = method == (before_4 ? "RANDOM_WALK" : "RANDOM_WALK_SKIN");
    const Fresnel entry = before_4 || burley ? Fresnel::none : skin ? Fresnel::schlick : Fresnel::dielectric;
    const std::uint32_t imm = static_cast<std::uint32_t>(bsdf::LobeKind::subsurface) |
                              static_cast<std::uint32_t>(entry) << lobe_fresnel_shift |
                              (burley ? lobe_preserve_energy : 0u) | lobe_keep | (l.v1 ? lobe_v1_exit : 0u) |
                              (skin ? lobe_skin_radius : 0u);
    const Ref alpha = skin ? b.constant(1) : l.alpha;
    b.emit(Op::lobe_subsurface,
           {l.weight.x, l.weight.y, l.weight.z, l.normal.x, l.normal.y, l.normal.z, l.albedo.x, l.albedo.y, l.albedo.z,
            l.radius.x, l.radius.y, l.radius.z, l.index, l.anisotropy, alpha},
           imm);
}

Ref NodeContext::sheen_lobe(Ref3 weight, Ref3 n, Ref roughness, Ref3 layer_weight) {
    if (!room_for_lobe(weight)) return b.constant(1);
    return b.emit(
        Op::lobe_sheen,
        {weight.x, weight.y, weight.z, n.x, n.y, n.z, roughness, layer_weight.x, layer_weight.y, layer_weight.z},
        static_cast<std::uint32_t>(bsdf::LobeKind::sheen));
}

Ref3 NodeContext::closure_normal(const char* id, bool glossy) {
    Ref3 n = normal();
    const bool own = linked(id);
    if (own) {
        const Ref3 v = vector(id);
        n = b.emit3(Op::normalize_or, {v.x, v.y, v.z, n.x, n.y, n.z});
        compiler_.own_normals_ = true;
    }
    const bool bends = glossy || (own && compiler_.normal_rules() < 2);
    return bends ? b.emit3(Op::bend_normal, {n.x, n.y, n.z}) : n;
}

}  // namespace cardioid::nodes
