// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodes/compile.h"

#include "nodes/emit_program.h"
#include "nodes/estimate.h"
#include "nodes/graph_compiler.h"
#include "nodes/op_modes.h"

#include <algorithm>

namespace cardioid::nodes {

namespace {

/// What Blender shows without nodes: one shader of one colour.
scene::GraphDesc plain_graph(const CompileContext& context) {
    scene::NodeDesc node;
    node.name = "Color";
    node.type = context.kind == GraphKind::material ? "ShaderNodeBsdfDiffuse" : "ShaderNodeBackground";
    scene::InputDesc color;
    color.value = {context.fallback_color.x, context.fallback_color.y, context.fallback_color.z, 1};
    node.inputs["Color"] = color;
    scene::GraphDesc graph;
    graph.nodes.push_back(node);
    graph.surface = {0, "Shader"};
    return graph;
}

bool uses(const Program& p, Op op) {
    return std::any_of(p.code.begin(), p.code.end(), [op](const Instruction& in) { return in.op == op; });
}

bool reads_triangle(const Program& p) {
    const auto frame = [](std::uint16_t arg) {
        if ((arg & operand_chunk) == 0) return false;
        const int row = arg & k_operand_index;
        return row >= static_cast<int>(ChunkRow::barycentric_u) && row < static_cast<int>(ChunkRow::footprint);
    };
    return uses(p, Op::attribute) || uses(p, Op::uv_tangent) || uses(p, Op::barycentric_step) ||
           uses(p, Op::wireframe) || std::any_of(p.args.begin(), p.args.end(), frame);
}

/// Sum of the operands of every `op`, when it is all that the program holds and is constant.
bool constant_sum(const Program& p, Op op, Float3& sum) {
    sum = {};
    for (const Instruction& in : p.code) {
        if (in.op != op) return false;
        float v[3];
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint16_t arg = p.args[in.args + c];
            if ((arg & operand_constant) == 0) return false;
            v[c] = p.constants[static_cast<std::size_t>(arg & k_operand_index) * k_constant_stride];
        }
        sum = sum + Float3{v[0], v[1], v[2]};
    }
    return true;
}

/// Least roughness of the glossy lobes that is sure before shading.
float least_alpha(const Program& p) {
    float least = 1e30f;
    for (const Instruction& in : p.code) {
        if (in.op != Op::lobe_ggx || (in.imm & lobe_keep) == 0) continue;
        float larger = 0;
        for (const std::uint32_t axis : {9u, 10u}) {
            const std::uint16_t arg = p.args[in.args + axis];
            const bool constant = (arg & operand_constant) != 0;
            larger =
                std::max(larger, constant ? p.constants[std::size_t(arg & k_operand_index) * k_constant_stride] : 0);
        }
        least = std::min(least, larger);
    }
    return least;
}

/// Every coefficient of the medium is a number.
bool is_constant_medium(const Program& p) {
    return std::all_of(p.args.begin(), p.args.end(), [](std::uint16_t arg) { return (arg & operand_constant) != 0; }) &&
           std::all_of(p.code.begin(), p.code.end(),
                       [](const Instruction& in) { return op_info(in.op).kind == OpKind::effect; });
}

/// Leaves a lobe in the output.
bool is_lobe(const Instruction& in) {
    const bool makes = in.op == Op::lobe_simple || in.op == Op::lobe_sheen || in.op == Op::lobe_ggx ||
                       in.op == Op::lobe_subsurface || in.op == Op::lobe_hair;
    return makes && (in.imm & lobe_keep) != 0;
}

ProgramInfo describe(const CompiledGraph& g) {
    const Program& surface = g.of(Purpose::surface);
    const Program& emission = g.of(Purpose::emission);
    const Program& transparency = g.of(Purpose::transparency);
    ProgramInfo info;
    info.has_emission = uses(emission, Op::emission);
    info.constant_emission = constant_sum(emission, Op::emission, info.emission_value);
    info.emission_estimate = info.constant_emission ? info.emission_value : estimate_emission(emission);
    info.has_transparency = uses(transparency, Op::transparent);
    info.has_holdout = uses(transparency, Op::holdout);
    info.constant_transparency = constant_sum(transparency, Op::transparent, info.transparency_value);
    info.transparency_needs_light_path = uses(transparency, Op::ray_value);
    info.needs_light_path = uses(surface, Op::ray_value);
    info.has_bump = uses(surface, Op::surface_step);
    info.sets_normal = uses(surface, Op::set_normal);
    info.needs_triangle_frame = reads_triangle(surface);
    info.needs_instance = uses(surface, Op::instance_value) || uses(surface, Op::named_value) ||
                          uses(surface, Op::transform) || uses(surface, Op::uv_tangent);
    info.lobes = static_cast<int>(std::count_if(surface.code.begin(), surface.code.end(), is_lobe));
    info.has_subsurface = uses(surface, Op::lobe_subsurface);
    info.has_lobes = info.lobes > 0;
    info.least_alpha = least_alpha(surface);
    info.has_displacement = uses(g.of(Purpose::displacement), Op::displacement);
    info.sends_rays = uses(surface, Op::ambient_occlusion) || uses(surface, Op::bevel) || uses(surface, Op::raycast);
    const Program& volume = g.of(Purpose::volume);
    info.has_volume = !volume.code.empty();
    info.constant_volume = is_constant_medium(volume);
    return info;
}

}  // namespace

CompiledGraph compile(const scene::GraphDesc& graph, const CompileContext& context, Warnings& warnings) {
    if (graph.empty()) return compile(plain_graph(context), context, warnings);
    GraphCompiler compiler(graph, context, warnings);
    compiler.run();
    CompiledGraph out;
    bool too_large = false;
    for (int k = 0; k < k_purposes; ++k)
        out.program[k] = emit_program(compiler.builder(), static_cast<Purpose>(k), context.images, too_large);
    if (too_large) {
        warnings.add(context.name + "/too large",
                     "The shader of '" + context.name + "' is too large; it is plain instead");
        return compile(plain_graph(context), context, warnings);
    }
    out.info = describe(out);
    out.info.own_normals = compiler.own_normals() || out.info.sets_normal;
    out.info.ggx_bump_shadow = compiler.own_normals() && compiler.normal_rules() >= 3;
    return out;
}

}  // namespace cardioid::nodes
