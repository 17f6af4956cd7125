// SPDX-License-Identifier: GPL-3.0-or-later
// All 32 767 strings of S and D up to length 14: the regular expressions of the classes (docs/architecture.md), read from the
// light, put each in exactly one class, and the automaton, read from the camera, says the same.
#include "path/automaton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <regex>
#include <string>
#include <vector>

namespace cardioid::path {
namespace {

/// Strings from the light, L and E left out.
std::vector<std::string> all_strings() {
    std::vector<std::string> all;
    for (int length = 0; length <= 14; ++length) {
        for (unsigned code = 0; code < (1u << length); ++code) {
            std::string s;
            for (int i = 0; i < length; ++i) s += (code >> i & 1u) != 0 ? 'S' : 'D';
            all.push_back(s);
        }
    }
    return all;
}

struct ClassPattern {
    PathClass path_class;
    std::regex from_light;
};

const std::vector<ClassPattern>& patterns() {
    static const std::vector<ClassPattern> all{{PathClass::d1, std::regex("S*")},
                                               {PathClass::d2, std::regex("DS*")},
                                               {PathClass::d3, std::regex("DD[SD]*")},
                                               {PathClass::c1, std::regex("S+D[SD]*")},
                                               {PathClass::c2, std::regex("DS+D[SD]*")}};
    return all;
}

PathClass by_expression(const std::string& from_light) {
    for (const ClassPattern& p : patterns()) {
        if (std::regex_match(from_light, p.from_light)) return p.path_class;
    }
    ADD_FAILURE() << from_light << " is in no class";
    return PathClass::d1;
}

using Step = std::function<State(State, bool)>;

PathClass by_automaton(const std::string& from_light, const Step& next) {
    State state = State::specular;
    for (auto c = from_light.rbegin(); c != from_light.rend(); ++c) state = next(state, *c == 'S');
    return class_of(state);
}

int disagreements(const Step& next) {
    int n = 0;
    for (const std::string& s : all_strings()) n += by_automaton(s, next) != by_expression(s);
    return n;
}

TEST(PathClasses, EveryStringIsInExactlyOneClass) {
    const auto all = all_strings();
    ASSERT_EQ(all.size(), 32767u);
    std::vector<int> members(k_classes, 0);
    for (const std::string& s : all) {
        const auto count = std::count_if(patterns().begin(), patterns().end(),
                                         [&](const ClassPattern& p) { return std::regex_match(s, p.from_light); });
        ASSERT_EQ(count, 1) << s;
        ++members[static_cast<std::size_t>(by_expression(s))];
    }
    for (const int n : members) EXPECT_GT(n, 10);
}

TEST(PathClasses, TheAutomatonAgrees) { EXPECT_EQ(disagreements(step), 0); }

TEST(PathClasses, EveryWrongTransitionIsNoticed) {
    for (int from = 0; from < k_states; ++from) {
        for (const bool specular : {false, true}) {
            for (int to = 0; to < k_states; ++to) {
                const State right = step(static_cast<State>(from), specular);
                if (to == static_cast<int>(right)) continue;
                const Step wrong = [=](State s, bool is_specular) {
                    return static_cast<int>(s) == from && is_specular == specular ? static_cast<State>(to)
                                                                                  : step(s, is_specular);
                };
                EXPECT_GT(disagreements(wrong), 0) << from << (specular ? " S " : " D ") << to;
            }
        }
    }
}

/// The photon side (spec 1), read from the light: a photon is stored at a D vertex when what it has passed, that vertex
/// included, matches S+ D (S|D)* or D S+ D (S|D)*; it dies when its string begins with D D.
bool photon_is_stored(const std::string& from_light, std::size_t vertex) {
    if (from_light[vertex] != 'D') return false;
    if (from_light.compare(0, 2, "DD") == 0 && vertex >= 1) return false;
    const std::size_t first_d = from_light.find('D');
    if (first_d > 0) return vertex >= first_d;
    const std::size_t next_d = from_light.find('D', 1);
    return next_d >= 2 && vertex >= next_d;
}

TEST(PathClasses, ExactlyOneSideEvaluatesAPath) {
    for (const std::string& s : all_strings()) {
        // Photons are gathered at the camera's first D, the last D from the light.
        const std::size_t gather_at = s.rfind('D');
        const bool by_photons = gather_at != std::string::npos && photon_is_stored(s, gather_at);
        ASSERT_EQ(by_photons, is_caustic(by_automaton(s, step))) << s;
    }
}

}  // namespace
}  // namespace cardioid::path
