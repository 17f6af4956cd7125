// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/problems.h"

#include <cmath>

namespace cardioid::scene {
namespace {

enum class Mark : std::uint8_t { fresh, open, done };

/// Depth first from every node; an input that leads back to an open node closes a loop and is unlinked.
class LoopCutter {
public:
    explicit LoopCutter(GraphDesc& graph) : graph_(graph), marks_(graph.nodes.size(), Mark::fresh) {}
    std::size_t run() {
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
            if (marks_[i] == Mark::fresh) visit(i);
        return cut_;
    }

private:
    struct Frame {
        std::size_t node;
        std::map<std::string, InputDesc>::iterator next;
    };
    // A stack of its own: graphs may be longer than the thread's stack is deep.
    void visit(std::size_t start) {
        std::vector<Frame> stack;
        open(stack, start);
        while (!stack.empty()) {
            Frame& top = stack.back();
            if (top.next == graph_.nodes[top.node].inputs.end()) {
                marks_[top.node] = Mark::done;
                stack.pop_back();
                continue;
            }
            InputDesc& input = (top.next++)->second;
            if (!input.linked()) continue;
            const auto source = static_cast<std::size_t>(input.node);
            if (marks_[source] == Mark::open) {
                input = {};
                ++cut_;
            } else if (marks_[source] == Mark::fresh) {
                open(stack, source);
            }
        }
    }
    void open(std::vector<Frame>& stack, std::size_t node) {
        marks_[node] = Mark::open;
        stack.push_back({node, graph_.nodes[node].inputs.begin()});
    }

    GraphDesc& graph_;
    std::vector<Mark> marks_;
    std::size_t cut_ = 0;
};

void check_output(OutputDesc& output, const char* what, std::size_t nodes, const std::string& who,
                  ProblemList& problems) {
    if (output.node < 0 || static_cast<std::size_t>(output.node) < nodes) return;
    problems.warn(who, "has a " + std::string(what) + " output linked to a node that does not exist; unlinked");
    output = {};
}

void check_inputs(NodeDesc& node, std::size_t nodes, const std::string& who, ProblemList& problems) {
    for (auto& [key, input] : node.inputs) {
        if (input.linked() && static_cast<std::size_t>(input.node) >= nodes) {
            problems.warn(who, "has input \"" + key + "\" linked to a node that does not exist; unlinked");
            input = {};
        }
        for (float& value : input.value) {
            if (finite(value)) continue;
            problems.warn(who, "has a value in input \"" + key + "\" that is not finite; 0 is used");
            value = 0;
        }
    }
}

void check_params(NodeDesc& node, std::size_t images, const std::string& who, ProblemList& problems) {
    for (auto& [key, param] : node.params) {
        if (double* number = std::get_if<double>(&param); number && !std::isfinite(*number)) {
            problems.warn(who, "has a property \"" + key + "\" that is not finite; 0 is used");
            *number = 0;
        } else if (auto* list = std::get_if<std::vector<double>>(&param)) {
            for (double& value : *list)
                if (!std::isfinite(value)) value = 0;
        }
    }
    const auto image = node.params.find("image");
    if (image == node.params.end()) return;
    const double* index = std::get_if<double>(&image->second);
    const double count = static_cast<double>(images);
    if (index && *index >= -1 && *index < count && *index == std::floor(*index)) return;
    problems.warn(who, "uses an image that does not exist");
    image->second = -1.0;
}

}  // namespace

void validate_graph(GraphDesc& graph, const std::string& who, std::size_t images, ProblemList& problems) {
    const std::size_t nodes = graph.nodes.size();
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::string node = who + ", " + label("node", graph.nodes[i].name, i);
        check_inputs(graph.nodes[i], nodes, node, problems);
        check_params(graph.nodes[i], images, node, problems);
    }
    check_output(graph.surface, "surface", nodes, who, problems);
    check_output(graph.volume, "volume", nodes, who, problems);
    check_output(graph.displacement, "displacement", nodes, who, problems);
    if (const std::size_t cut = LoopCutter(graph).run())
        problems.warn(who, "has " + counted(cut, "link", "links") + " that make a loop of nodes; unlinked");
}

}  // namespace cardioid::scene
