// SPDX-License-Identifier: GPL-3.0-or-later
// All 32 767 strings of S and D up to length 14: the regular expressions of the classes (docs/architecture.md), read from the
// light, put each in exactly one class, and the automaton, read from the camera, says the same.
#include "path/partition.h"

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
constexpr State (*k_step)(State, bool) = step;

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

TEST(PathClasses, TheAutomatonAgrees) { EXPECT_EQ(disagreements(k_step), 0); }

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
        ASSERT_EQ(by_photons, is_caustic(by_automaton(s, k_step))) << s;
    }
}

/// What the photon automaton stores of a string, read from the light, at its last D: there camera paths gather. -1: nothing.
int stored_by_automaton(const std::string& from_light, ClassSet classes) {
    const std::size_t gather_at = from_light.rfind('D');
    if (gather_at == std::string::npos) return -1;
    PhotonState state = PhotonState::start;
    for (std::size_t i = 0; i < gather_at; ++i) {
        state = step(state, from_light[i] == 'S');
        if ((reachable(state) & classes) == 0) return -1;
    }
    const PathClass c = stored_class(state);
    return (bit(c) & classes) != 0 ? static_cast<int>(c) : -1;
}

TEST(PhotonAutomaton, StoresWhatTheExpressionsSayAndNoMore) {
    constexpr ClassSet caustics = bit(PathClass::c1) | bit(PathClass::c2);
    constexpr ClassSet all_but_d1 = k_all_classes & ~bit(PathClass::d1);
    for (const std::string& s : all_strings()) {
        const PathClass c = by_expression(s);
        ASSERT_EQ(stored_by_automaton(s, caustics), is_caustic(c) ? static_cast<int>(c) : -1) << s;
        ASSERT_EQ(stored_by_automaton(s, bit(PathClass::c1)), c == PathClass::c1 ? 3 : -1) << s;
        ASSERT_EQ(stored_by_automaton(s, all_but_d1), c == PathClass::d1 ? -1 : static_cast<int>(c)) << s;
    }
}

/// Whether the path of the string, read from the camera, lives to have light attached, when camera paths die where none of
/// their classes can come.
bool camera_lives(const std::string& from_light, ClassSet classes) {
    State state = State::specular;
    for (auto c = from_light.rbegin(); c != from_light.rend(); ++c) {
        state = k_step(state, *c == 'S');
        if ((reachable(state) & classes) == 0) return false;
    }
    return (bit(class_of(state)) & classes) != 0;
}

TEST(Partition, EveryPathIsEstimatedOnce) {
    using scene::IndirectCaustics;
    using scene::IntegratorKind;
    for (const auto kind : {IntegratorKind::path_tracing, IntegratorKind::hybrid, IntegratorKind::photon_mapping}) {
        for (const auto indirect : {IndirectCaustics::photons, IndirectCaustics::path_tracing}) {
            scene::Settings settings;
            settings.integrator = kind;
            settings.indirect_caustics = indirect;
            const Partition p = make_partition(settings, true);
            for (const std::string& s : all_strings()) {
                const int sides = camera_lives(s, p.camera) + (stored_by_automaton(s, p.photons) >= 0);
                ASSERT_EQ(sides, 1) << s << ", integrator " << static_cast<int>(kind);
            }
        }
    }
    scene::Settings off;
    off.integrator = IntegratorKind::hybrid;
    off.indirect_caustics = IndirectCaustics::off;
    const Partition p = make_partition(off, true);
    EXPECT_EQ(p.camera | p.photons, k_all_classes & ~bit(PathClass::c2));
    EXPECT_EQ(make_partition(off, false).camera, k_all_classes) << "nothing to catch: path tracing";
}

}  // namespace
}  // namespace cardioid::path
