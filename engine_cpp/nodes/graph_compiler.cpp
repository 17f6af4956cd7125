// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/graph_compiler.h"

#include "nodes/node_helpers.h"

#include <algorithm>

namespace cardioid::nodes {

namespace {

const char* kind_name(GraphKind kind) {
    switch (kind) {
        case GraphKind::world: return "world";
        case GraphKind::light: return "light";
        default: return "material";
    }
}

/// The version of nodes that make normals tells what Blender does with them.
int normal_rules_of(const scene::NodeDesc& node) {
    for (const char* type : {"ShaderNodeBump", "ShaderNodeNormalMap", "ShaderNodeDisplacement"}) {
        if (node.type != type) continue;
        const auto at = node.params.find("version");
        const double* version = at == node.params.end() ? nullptr : std::get_if<double>(&at->second);
        return version == nullptr ? 1 : static_cast<int>(*version);
    }
    return 1;
}

}  // namespace

GraphCompiler::GraphCompiler(const scene::GraphDesc& graph, const CompileContext& context, Warnings& warnings)
    : graph_(graph),
      context_(context),
      warnings_(warnings),
      builder_(context.optimise),
      types_(graph.nodes.size()),
      weight_(graph.nodes.size()),
      reached_(graph.nodes.size(), false) {
    for (std::size_t k = 0; k < graph_.nodes.size(); ++k) {
        types_[k] = find_node_type(graph_.nodes[k].type);
        normal_rules_ = std::max(normal_rules_, normal_rules_of(graph_.nodes[k]));
    }
    normal_ = builder_.chunk3(ChunkRow::normal);
    cut_bad_links();
    cut_loops();
}

std::string GraphCompiler::place(int node) const {
    return "Node '" + graph_.nodes[static_cast<std::size_t>(node)].name + "' in " + kind_name(context_.kind) + " '" +
           context_.name + "'";
}

void GraphCompiler::cut_bad_links() {
    const int count = static_cast<int>(graph_.nodes.size());
    for (int k = 0; k < count; ++k) {
        for (auto& [id, input] : graph_.nodes[static_cast<std::size_t>(k)].inputs) {
            if (!input.linked()) continue;
            if (input.node < count) {
                used_.emplace(input.node, input.socket);
                continue;
            }
            warn(context_.name + "/missing node",
                 place(k) + ": the link to '" + id + "' comes from a node that does not exist");
            input.node = -1;
        }
    }
    for (scene::OutputDesc* out : {&graph_.surface, &graph_.volume, &graph_.displacement})
        if (out->node >= count) out->node = -1;
    for (const scene::OutputDesc& out : {graph_.surface, graph_.volume, graph_.displacement})
        if (out.node >= 0) used_.emplace(out.node, out.socket);
}

/// Depth-first over all nodes; a link back to a node that is still open closes a loop and is cut.
void GraphCompiler::cut_loops() {
    enum class State : std::uint8_t { fresh, open, done };
    struct Frame {
        int node;
        std::map<std::string, scene::InputDesc>::iterator next;
    };
    std::vector<State> state(graph_.nodes.size(), State::fresh);
    std::vector<Frame> stack;
    const auto enter = [&](int n) {
        state[static_cast<std::size_t>(n)] = State::open;
        stack.push_back({n, graph_.nodes[static_cast<std::size_t>(n)].inputs.begin()});
    };
    for (int start = 0; start < static_cast<int>(graph_.nodes.size()); ++start) {
        if (state[static_cast<std::size_t>(start)] != State::fresh) continue;
        enter(start);
        while (!stack.empty()) {
            Frame& f = stack.back();
            if (f.next == graph_.nodes[static_cast<std::size_t>(f.node)].inputs.end()) {
                state[static_cast<std::size_t>(f.node)] = State::done;
                stack.pop_back();
                continue;
            }
            scene::InputDesc& input = (f.next++)->second;
            if (!input.linked()) continue;
            const State s = state[static_cast<std::size_t>(input.node)];
            if (s == State::open) {
                warn(context_.name + "/loop", place(f.node) + " is part of a loop; the link that closes it is ignored");
                input.node = -1;
            } else if (s == State::fresh) {
                enter(input.node);
            }
        }
    }
}

void GraphCompiler::run() {
    move_vertices();
    run_surface();
    run_volume();
}

void GraphCompiler::run_surface() {
    const scene::OutputDesc& surface = graph_.surface;
    if (surface.node < 0) {
        // A medium alone has no surface: rays enter it as they are. Nothing at all is black.
        if (graph_.volume.node >= 0 && context_.kind == GraphKind::material)
            builder_.transparent(builder_.constant({1, 1, 1}));
        return;
    }
    bump_displacement();
    if (is_closure(surface.node)) {
        run_closures(surface.node);
        return;
    }
    if (types_[static_cast<std::size_t>(surface.node)] == nullptr) {
        unknown_surface(surface.node, builder_.constant(1));
        return;
    }
    // A colour as a surface is emission of that colour.
    evaluate(surface.node, Shift::none);
    const Value* v = output(surface.node, surface.socket, Shift::none);
    if (v != nullptr) builder_.emission(v->type == Value::Type::number ? builder_.broadcast(v->v.x) : v->v);
}

/// The medium behind the surface, or of the world. Lamps have none.
void GraphCompiler::run_volume() {
    const scene::OutputDesc& out = graph_.volume;
    if (out.node < 0 || context_.kind == GraphKind::light) return;
    in_volume_ = true;
    if (is_closure(out.node)) {
        run_closures(out.node);
    } else if (types_[static_cast<std::size_t>(out.node)] == nullptr) {
        name_unknown(out.node);
    } else {
        evaluate(out.node, Shift::none);
        const Value* v = output(out.node, out.socket, Shift::none);
        if (v != nullptr) builder_.medium_emission(v->type == Value::Type::number ? builder_.broadcast(v->v.x) : v->v);
    }
    for (const Phase& p : phases_) builder_.medium_phase(p.kind, p.scatter, p.parameter);
}

void GraphCompiler::add_phase(PhaseKind kind, Ref3 scatter, Ref3 parameter, int node) {
    const auto same = std::find_if(phases_.begin(), phases_.end(), [&](const Phase& p) {
        return p.kind == kind && (kind == PhaseKind::rayleigh || p.parameter == parameter);
    });
    if (same != phases_.end()) {
        same->scatter = builder_.add(same->scatter, scatter);
    } else if (phases_.size() < static_cast<std::size_t>(k_max_phases)) {
        phases_.push_back({kind, scatter, parameter});
    } else {
        warn(context_.name + "/phases",
             place(node) +
                 ": the volume scatters in more ways than can be kept; this one is shaped like the one before");
        phases_.back().scatter = builder_.add(phases_.back().scatter, scatter);
    }
}

float GraphCompiler::set_step(float pixels) {
    const float before = step();
    const auto at = std::find(steps_.begin(), steps_.end(), pixels);
    step_ = static_cast<int>(at - steps_.begin());
    if (at == steps_.end()) steps_.push_back(pixels);
    return before;
}

void GraphCompiler::move_vertices() {
    const scene::OutputDesc& out = graph_.displacement;
    if (out.node < 0 || context_.kind != GraphKind::material || is_closure(out.node)) return;
    if (context_.displacement_method == scene::DisplacementMethod::bump) return;
    evaluate(out.node, Shift::none);
    const Value* v = output(out.node, out.socket, Shift::none);
    if (v == nullptr) return;
    builder_.displacement(v->type == Value::Type::number ? builder_.broadcast(v->v.x) : v->v);
    moved_ = true;
    // On the moved surface positions mean something else.
    outputs_.clear();
}

/// The height is the displacement along the normal. A material that moves its vertices too is bumped in object space, from
/// the surface before it moved.
void GraphCompiler::bump_displacement() {
    const scene::OutputDesc& out = graph_.displacement;
    if (out.node < 0 || context_.kind != GraphKind::material || is_closure(out.node)) return;
    if (context_.displacement_method == scene::DisplacementMethod::displacement) return;
    NodeContext c(*this, out.node, Shift::none, nullptr);
    // Before Blender 3.6 reflections are kept above the surface; 4.5 and later make the step a tenth of a pixel.
    const auto version = static_cast<int>(c.property("version", 1));
    const float before = set_step(version >= 3 ? 0.1f : 1.0f);
    undisplaced_ = moved_;
    Ref height[3];
    bool found = true;
    for (const Shift shift : {Shift::none, Shift::x, Shift::y}) {
        evaluate(out.node, shift);
        const Value* v = output(out.node, out.socket, shift);
        found = found && v != nullptr;
        if (!found) break;
        height[static_cast<int>(shift)] =
            builder_.dot(v->type == Value::Type::number ? builder_.broadcast(v->v.x) : v->v, normal_);
    }
    if (found) {
        const Ref one = builder_.constant(1);
        const Ref dx = builder_.subtract(height[1], height[0]), dy = builder_.subtract(height[2], height[0]);
        normal_ = moved_ ? bumped_in_object_space(c, normal_, dx, dy, one, one) : bumped(c, normal_, dx, dy, one, one);
        if (version < 2) normal_ = builder_.emit3(Op::bend_normal, {normal_.x, normal_.y, normal_.z});
        builder_.set_normal(normal_);
    }
    undisplaced_ = false;
    set_step(before);
    // What was computed so far saw the plain normal.
    outputs_.clear();
}

/// Closures reachable from the root, each before those that it mixes.
std::vector<int> GraphCompiler::closure_order(int root) const {
    std::vector<int> finished;
    std::vector<bool> seen(graph_.nodes.size(), false);
    struct Frame {
        int node;
        std::map<std::string, scene::InputDesc>::const_iterator next;
    };
    std::vector<Frame> stack;
    const auto enter = [&](int n) {
        seen[static_cast<std::size_t>(n)] = true;
        stack.push_back({n, graph_.nodes[static_cast<std::size_t>(n)].inputs.begin()});
    };
    enter(root);
    while (!stack.empty()) {
        Frame& f = stack.back();
        if (f.next == graph_.nodes[static_cast<std::size_t>(f.node)].inputs.end()) {
            finished.push_back(f.node);
            stack.pop_back();
            continue;
        }
        const scene::InputDesc& input = (f.next++)->second;
        if (input.linked() && is_closure(input.node) && !seen[static_cast<std::size_t>(input.node)]) enter(input.node);
    }
    std::reverse(finished.begin(), finished.end());
    return finished;
}

void GraphCompiler::run_closures(int root) {
    const Ref zero = builder_.constant(0);
    std::fill(weight_.begin(), weight_.end(), zero);
    std::fill(reached_.begin(), reached_.end(), false);
    weight_[static_cast<std::size_t>(root)] = builder_.constant(1);
    reached_[static_cast<std::size_t>(root)] = true;
    for (const int node : closure_order(root)) {
        const Ref weight = weight_[static_cast<std::size_t>(node)];
        if (!reached_[static_cast<std::size_t>(node)] || (context_.optimise && builder_.is(weight, 0))) continue;
        evaluate_inputs(node, Shift::none);
        NodeContext context(*this, node, Shift::none, nullptr);
        types_[static_cast<std::size_t>(node)]->closure(context, weight);
    }
}

void GraphCompiler::name_unknown(int node) {
    const scene::NodeDesc& n = graph_.nodes[static_cast<std::size_t>(node)];
    warn("type " + n.type, "Node '" + n.name + "' (" + n.type + ") in " + kind_name(context_.kind) + " '" +
                               context_.name + "' is not supported; it uses its default");
}

void GraphCompiler::unknown_surface(int node, Ref weight) {
    name_unknown(node);
    if (graph_.nodes[static_cast<std::size_t>(node)].type.find("Tex") != std::string::npos) return;
    NodeContext c(*this, node, Shift::none, nullptr);
    const Ref grey = builder_.multiply(builder_.constant(0.8f), weight);
    c.simple_lobe(bsdf::LobeKind::diffuse, builder_.broadcast(grey), c.normal(), builder_.constant(0), false,
                  builder_.broadcast(grey));
}

void GraphCompiler::evaluate_inputs(int node, Shift shift) {
    for (const auto& [id, input] : graph_.nodes[static_cast<std::size_t>(node)].inputs)
        if (input.linked() && !is_closure(input.node)) evaluate(input.node, shift);
}

/// Depth-first with a stack of its own: graphs may be thousands of nodes deep.
void GraphCompiler::evaluate(int root, Shift shift) {
    struct Frame {
        int node;
        bool inputs_done;
    };
    const auto key = [this, shift](int n) { return this->key(n, shift); };
    std::vector<Frame> stack{{root, false}};
    while (!stack.empty()) {
        const Frame f = stack.back();
        if (outputs_.contains(key(f.node)) && !f.inputs_done) {
            stack.pop_back();
            continue;
        }
        const NodeType* type = types_[static_cast<std::size_t>(f.node)];
        if (type == nullptr) name_unknown(f.node);
        if (type == nullptr || type->values == nullptr) {
            outputs_[key(f.node)];
            stack.pop_back();
            continue;
        }
        if (!f.inputs_done) {
            stack.back().inputs_done = true;
            for (const auto& [id, input] : graph_.nodes[static_cast<std::size_t>(f.node)].inputs)
                if (input.linked() && !is_closure(input.node) && !outputs_.contains(key(input.node)))
                    stack.push_back({input.node, false});
            continue;
        }
        stack.pop_back();
        if (outputs_.contains(key(f.node))) continue;
        Outputs results;
        NodeContext context(*this, f.node, shift, &results);
        type->values(context);
        outputs_[key(f.node)] = std::move(results);
    }
}

const Value* GraphCompiler::output(int node, const std::string& socket, Shift shift) {
    const auto found = outputs_.find(key(node, shift));
    if (found == outputs_.end()) return nullptr;
    const auto value = found->second.find(socket);
    if (value != found->second.end()) return &value->second;
    const NodeType* type = types_[static_cast<std::size_t>(node)];
    if (type != nullptr && type->values != nullptr)
        warn(context_.name + "/" + graph_.nodes[static_cast<std::size_t>(node)].type + "/" + socket,
             place(node) + " has no output '" + socket + "' here; what it is linked to uses its default");
    return nullptr;
}

}  // namespace cardioid::nodes
