// SPDX-License-Identifier: GPL-3.0-or-later
// What a node's translator sees: its inputs as rows, its properties, and a place for its outputs.
#pragma once

#include "nodes/graph_compiler.h"
#include "nodes/op_modes.h"

namespace cardioid::nodes {

/// Operands of a microfacet lobe; what is left alone is neutral.
struct GgxLobe {
    bsdf::LobeKind kind = bsdf::LobeKind::ggx_reflection;
    bsdf::Fresnel fresnel = bsdf::Fresnel::none;
    bsdf::Distribution distribution = bsdf::Distribution::ggx;
    bool preserve_energy = false;
    bool separable_masking = false;
    bool walks_facets = false;
    Ref3 weight, normal, tangent;
    Ref alpha_x, alpha_y, eta;
    Ref3 f0, f90, tint, layer_weight;
    Ref film_thickness, film_ior;  ///< in nm, 0: none; relative to wo's side
};

/// Operands of a hair lobe: rows as bsdf/lobe.h has them.
struct HairLobe {
    bsdf::LobeKind kind = bsdf::LobeKind::hair_chiang;
    Ref3 weight, normal, tangent;
    Ref alpha_x, alpha_y, third, eta;
    Ref3 f0, f90, tint;
};

/// Operands of a subsurface lobe.
struct SubsurfaceLobe {
    Ref3 weight, normal, albedo, radius;
    Ref index, anisotropy, alpha;
    bool v1 = false;  ///< of Principled before Blender 4.0
};

class NodeContext {
public:
    NodeContext(GraphCompiler& compiler, int index, Shift shift, Outputs* outputs)
        : b(compiler.builder()),
          node(compiler.graph_.nodes[static_cast<std::size_t>(index)]),
          compiler_(compiler),
          index_(index),
          shift_(shift),
          outputs_(outputs) {}

    Builder& b;
    const scene::NodeDesc& node;

    // Inputs by socket identifier. An input that is absent gives the fallback; links are converted as Blender does.
    bool has(const char* id) const { return node.inputs.contains(id); }
    bool linked(const char* id) const { return source(id) != nullptr; }
    Ref number(const char* id, float fallback = 0);
    Ref3 vector(const char* id, Float3 fallback = {});
    Ref3 color(const char* id, Float3 fallback = {});
    /// The linked vector, or the given one.
    Ref3 vector_or(const char* id, Ref3 unlinked) { return linked(id) ? vector(id) : unlinked; }

    // Properties.
    bool flag(const char* name, bool fallback = false) const;
    double property(const char* name, double fallback = 0) const;
    std::string text(const char* name, const char* fallback = "") const;
    std::vector<double> list(const char* name) const;

    // Outputs.
    /// Something is linked to this output.
    bool used(const char* id) const { return compiler_.used_.contains({index_, id}); }
    void number_out(const char* id, Ref v) { (*outputs_)[id] = {Value::Type::number, {v, v, v}}; }
    void vector_out(const char* id, Ref3 v) { (*outputs_)[id] = {Value::Type::vector, v}; }
    void color_out(const char* id, Ref3 v) { (*outputs_)[id] = {Value::Type::color, v}; }

    // Geometry, at the place where this node is evaluated.
    Ref3 position();
    Ref3 object_position();
    Ref3 generated();
    Ref3 normal() { return compiler_.normal(); }
    Ref barycentric_u() { return barycentric(0); }
    Ref barycentric_v() { return barycentric(1); }
    /// Id of an attribute name; -1 (as unsigned) when the caller keeps no names.
    std::uint32_t attribute_id(const std::string& name);
    /// Attribute by name: x, y, z, w rows; `missing` is an AttributeMissing.
    Results attribute(const std::string& name, std::uint32_t missing = 0);
    /// What the instance has by that name (scene::InstanceValueDesc): x, y, z, w rows.
    Results instance_value(const std::string& name);
    GraphKind kind() const { return compiler_.context().kind; }
    Shift shift() const { return shift_; }
    /// The same node, evaluated at another place.
    NodeContext at(Shift shift) const { return {compiler_, index_, shift, nullptr}; }
    const image::ImageStore* images() const { return compiler_.context().images; }
    /// Where the surface goes on by the bump's step along an axis.
    Ref3 step(Shift axis);
    /// The value of a linked number input at another place; unlinked: its own value.
    Ref number_at(const char* id, Shift shift, float fallback);
    /// Length of the step in pixels; returns the one before.
    float set_step(float pixels) { return compiler_.set_step(pixels); }

    // Closures.
    /// Gives `weight` to what is linked to a shader input.
    void shader(const char* id, Ref weight);
    /// Of the surface, or of the medium where the volume is walked.
    void emission(Ref3 radiance);
    // Surfaces alone.
    void transparent(Ref3 weight);
    void holdout(Ref weight);
    // Volumes alone: coefficients per scene unit, negative ones are 0.
    bool in_volume() const { return compiler_.in_volume(); }
    void absorption(Ref3 coefficient);
    void scattering(PhaseKind phase, Ref3 coefficient, Ref3 parameter);
    void simple_lobe(bsdf::LobeKind kind, Ref3 weight, Ref3 normal, Ref roughness, bool preserve_energy, Ref3 color);
    /// Returns the share of light that passes to the layers below (meaningful with layer_weight).
    Ref ggx_lobe(const GgxLobe& lobe);
    Ref sheen_lobe(Ref3 weight, Ref3 normal, Ref roughness, Ref3 layer_weight);
    GgxLobe ggx();
    void hair_lobe(const HairLobe& lobe);
    /// `method`: the node's enum. Before 4.0 its names meant other things and walks entered diffusely.
    void subsurface_lobe(const SubsurfaceLobe& lobe, const std::string& method, bool before_4);
    /// The input "Normal" (or another) of a closure: unit, bent for glossy ones.
    Ref3 closure_normal(const char* id, bool glossy);

    void warn(const std::string& key, const std::string& message) { compiler_.warn(key, message); }
    std::string place() const { return compiler_.place(index_); }

private:
    const Value* source(const char* id) const;
    const scene::InputDesc* input(const char* id) const;
    Ref barycentric(int k);
    /// World position before the vertices moved; `moved` where the mesh does not keep it.
    Ref3 undisplaced(Ref3 moved);
    bool room_for_lobe(Ref3 weight);

    GraphCompiler& compiler_;
    int index_;
    Shift shift_;
    Outputs* outputs_;
};

}  // namespace cardioid::nodes
