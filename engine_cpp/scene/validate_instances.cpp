// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/problems.h"

#include <algorithm>

namespace cardioid::scene {
namespace {

constexpr float k_flat = 1e-4f;  ///< thickness given to an axis that was scaled to zero, relative to the others

/// An object scaled to zero along one axis is still seen, as a sheet: the axis gets a little thickness. False if
/// nothing of it can be seen.
bool make_invertible(Affine& transform, bool& repaired) {
    Float3 axis[3] = {transform.column(0), transform.column(1), transform.column(2)};
    float longest = 0;
    for (const Float3 a : axis) longest = std::max(longest, length(a));
    if (!(longest > 0)) return false;
    // Judged on unit axes, so that a small object is not taken for a flat one.
    const auto flat = [&](Float3 a) { return length(a) < 1e-12f * longest; };
    const auto flat_axes = std::count_if(axis, axis + 3, flat);
    if (flat_axes == 0) {
        const Float3 x = normalize(axis[0]), y = normalize(axis[1]), z = normalize(axis[2]);
        return std::abs(dot(x, cross(y, z))) > 1e-7f && transform.determinant() != 0;
    }
    if (flat_axes > 1) return false;
    for (int i = 0; i < 3; ++i) {
        if (!flat(axis[i])) continue;
        const Float3 normal = normalize(cross(axis[(i + 1) % 3], axis[(i + 2) % 3]));
        if (normal == Float3{}) return false;
        const Float3 thin = normal * (k_flat * longest);
        transform.m[static_cast<std::size_t>(i)] = thin.x;
        transform.m[static_cast<std::size_t>(4 + i)] = thin.y;
        transform.m[static_cast<std::size_t>(8 + i)] = thin.z;
    }
    repaired = true;
    return transform.determinant() != 0;
}

class InstanceChecker {
public:
    InstanceChecker(SceneDesc& scene, ProblemList& problems) : scene_(scene), problems_(problems) {}

    void run(std::vector<InstanceDesc>& instances) {
        std::size_t index = 0;
        std::erase_if(instances, [&](InstanceDesc& instance) { return !check(instance, index++); });
    }

private:
    bool check(InstanceDesc& instance, std::size_t index) {
        const std::string who = label("object", instance.name, index);
        if (!refers(instance, who) || !placed(instance, who)) return false;
        for (int& material : instance.materials) {
            if (material >= -1 && material < static_cast<int>(scene_.materials.size())) continue;
            problems_.warn(who, "uses a material that does not exist; the default grey is used");
            material = -1;
        }
        instance.visibility &= visible_all;
        repair(problems_, who, "random", instance.random, 0, 1, 0);
        repair(problems_, who, "terminator_geometry", instance.terminator_geometry, 0, 1, 0);
        repair(problems_, who, "terminator_shading", instance.terminator_shading, 0, 1, 0);
        for (float* value : {&instance.color[0], &instance.color[1], &instance.color[2], &instance.color[3],
                             &instance.dupli_generated.x, &instance.dupli_generated.y, &instance.dupli_generated.z,
                             &instance.dupli_uv[0], &instance.dupli_uv[1]}) {
            if (finite(*value)) continue;
            problems_.warn(who, "has a colour or instance coordinate that is not finite; 0 is used");
            *value = 0;
        }
        check_values(instance, who);
        return true;
    }

    void check_values(InstanceDesc& instance, const std::string& who) {
        std::erase_if(instance.values, [&](const InstanceValueDesc& v) {
            if (!v.name.empty()) return false;
            problems_.warn(who, "has a value without a name; ignored");
            return true;
        });
        for (InstanceValueDesc& v : instance.values) {
            for (float& number : v.value) {
                if (finite(number)) continue;
                problems_.warn(who, "has a value \"" + v.name + "\" that is not finite; 0 is used");
                number = 0;
            }
        }
    }

    bool refers(const InstanceDesc& instance, const std::string& who) {
        const bool mesh = instance.mesh >= 0, group = instance.group >= 0;
        if (mesh == group) {
            problems_.warn(who, mesh ? "places both a mesh and a group; left out" : "places nothing; left out");
            return false;
        }
        if (instance.mesh >= static_cast<int>(scene_.meshes.size()) ||
            instance.group >= static_cast<int>(scene_.groups.size())) {
            problems_.warn(who, "places a mesh or group that does not exist; left out");
            return false;
        }
        // The mesh itself was named already.
        return group || !scene_.meshes[static_cast<std::size_t>(instance.mesh)].triangles.empty();
    }

    bool placed(InstanceDesc& instance, const std::string& who) {
        if (!finite(instance.transform)) {
            problems_.warn(who, "has a transform that is not finite; left out");
            return false;
        }
        bool flattened = false;
        if (!make_invertible(instance.transform, flattened)) {
            problems_.warn(who, "has a singular transform (scaled to zero); left out");
            return false;
        }
        if (flattened) problems_.warn(who, "is scaled to zero along one axis; rendered as a thin sheet");
        return true;
    }

    SceneDesc& scene_;
    ProblemList& problems_;
};

/// Names the first group of every loop. Iterative: groups may be nested deeply.
void find_group_loops(const SceneDesc& scene, ProblemList& problems) {
    struct Frame {
        std::size_t group, next;
    };
    enum class Mark : std::uint8_t { fresh, open, done };
    std::vector<Mark> marks(scene.groups.size(), Mark::fresh);
    for (std::size_t start = 0; start < scene.groups.size(); ++start) {
        if (marks[start] != Mark::fresh) continue;
        std::vector<Frame> stack{{start, 0}};
        marks[start] = Mark::open;
        while (!stack.empty()) {
            Frame& top = stack.back();
            const auto& instances = scene.groups[top.group].instances;
            if (top.next == instances.size()) {
                marks[top.group] = Mark::done;
                stack.pop_back();
                continue;
            }
            const InstanceDesc& instance = instances[top.next++];
            if (instance.group < 0) continue;
            const auto inner = static_cast<std::size_t>(instance.group);
            if (marks[inner] == Mark::open) {
                problems.error(label("group", scene.groups[inner].name, inner) + " contains itself, through " +
                               label("object", instance.name, top.next - 1));
            } else if (marks[inner] == Mark::fresh) {
                marks[inner] = Mark::open;
                stack.push_back({inner, 0});
            }
        }
    }
}

}  // namespace

void validate_instances(SceneDesc& scene, ProblemList& problems) {
    InstanceChecker checker(scene, problems);
    for (GroupDesc& group : scene.groups) checker.run(group.instances);
    checker.run(scene.instances);
    find_group_loops(scene, problems);
}

}  // namespace cardioid::scene
