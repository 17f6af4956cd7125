// SPDX-License-Identifier: GPL-3.0-or-later
// Walks a shading graph and lets each node's translator write instructions. Loops, dangling links and unknown nodes are
// cut and named; nothing here recurses over the graph's size.
#pragma once

#include "nodes/builder.h"
#include "nodes/compile.h"
#include "nodes/node_types.h"
#include "nodes/shading.h"

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace cardioid::nodes {

/// Where a node is evaluated: at the point, or a pixel's width beside it (for bump mapping).
enum class Shift : std::uint8_t { none, x, y };

struct Value {
    enum class Type : std::uint8_t { number, vector, color };
    Type type = Type::number;
    Ref3 v;  ///< a number is v.x
};
using Outputs = std::map<std::string, Value>;

class GraphCompiler {
public:
    GraphCompiler(const scene::GraphDesc& graph, const CompileContext& context, Warnings& warnings);

    void run();

    Builder& builder() { return builder_; }
    const CompileContext& context() const { return context_; }
    int lobes() const { return lobes_; }
    /// The shading normal; bumped where the material's displacement is.
    Ref3 normal() const { return normal_; }
    /// The volume output is being walked: surfaces are left out, emission is that of the medium.
    bool in_volume() const { return in_volume_; }
    /// Lobes may have normals that the graph made.
    bool own_normals() const { return own_normals_; }
    /// What Blender does with such normals: 1 before 3.6 (reflections of all lobes stay above the surface), 2 later (of glossy
    /// ones), 3 since 4.5 (and bumps of diffuse ones are shadowed by a GGX term).
    int normal_rules() const { return normal_rules_; }
    float step() const { return steps_[static_cast<std::size_t>(step_)]; }
    /// A scattering part of the medium; parts of one kind and parameter are summed.
    void add_phase(PhaseKind kind, Ref3 scatter, Ref3 parameter, int node);

private:
    friend class NodeContext;

    static constexpr int k_max_bump_depth = 16;

    void cut_bad_links();
    void cut_loops();
    /// Displacement of the vertices, when the material's method asks for it.
    void move_vertices();
    /// Displacement that turns the normal alone.
    void bump_displacement();
    /// Key of a node's results at a place: shifted ones depend on the step's length too.
    int key(int node, Shift shift) const {
        const int count = static_cast<int>(graph_.nodes.size());
        return (shift == Shift::none ? 0 : step_ * count * 3) + node * 3 + static_cast<int>(shift);
    }
    /// Length of the bump's step in pixels; returns the one before.
    float set_step(float pixels);
    void run_surface();
    void run_volume();
    void run_closures(int root);
    std::vector<int> closure_order(int root) const;
    bool is_closure(int node) const { return types_[node] != nullptr && types_[node]->closure != nullptr; }
    void name_unknown(int node);
    /// An unknown shader is diffuse grey; an unknown texture gives nothing.
    void unknown_surface(int node, Ref weight);
    void evaluate(int node, Shift shift);
    void evaluate_inputs(int node, Shift shift);
    const Value* output(int node, const std::string& socket, Shift shift);
    void warn(const std::string& key, const std::string& text) { warnings_.add(key, text); }
    std::string place(int node) const;

    scene::GraphDesc graph_;
    const CompileContext& context_;
    Warnings& warnings_;
    Builder builder_;
    std::vector<const NodeType*> types_;
    std::unordered_map<int, Outputs> outputs_;  ///< by key()
    std::vector<float> steps_{1.0f};            ///< lengths of bump steps, in pixels
    int step_ = 0;                              ///< the one in use
    std::vector<Ref> weight_;                   ///< of closures, summed over all ways to reach them
    std::vector<bool> reached_;
    std::set<std::pair<int, std::string>> used_;  ///< outputs that something is linked to
    Ref3 normal_;
    int bump_depth_ = 0;
    int normal_rules_ = 1;
    bool own_normals_ = false;
    int lobes_ = 0;
    struct Phase {
        PhaseKind kind;
        Ref3 scatter, parameter;
    };
    std::vector<Phase> phases_;
    bool in_volume_ = false;
    bool moved_ = false;        ///< the material moves its vertices
    bool undisplaced_ = false;  ///< positions are those before the vertices moved
};

}  // namespace cardioid::nodes
