// SPDX-License-Identifier: GPL-3.0-or-later
#include "photon/guide.h"

#include "photon/cube_tree.h"
#include "photon/pick.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cardioid::photon {

namespace {

/// Share of the photons that leave as at the start: no density falls below this times what it was (docs/photon-map.md).
constexpr double k_uniform = 0.2;
/// Bounds of the strength of the belief that emitters matter by their power, in lessons.
constexpr double k_weakest_prior = 1e-6, k_strongest_prior = 1e4;
constexpr std::size_t k_fewest_shares = 32;
constexpr std::size_t k_most_lessons = std::size_t{1} << 16;
constexpr float k_most_gain = 1e4f;

bool usable(const Lesson& lesson, const Pick& start) {
    if (lesson.emitter < 0 || static_cast<std::size_t>(lesson.emitter) >= start.size()) return false;
    if (!(lesson.value > 0 && lesson.density > 0) || !std::isfinite(lesson.value) || !std::isfinite(lesson.density))
        return false;
    for (const float u : lesson.u) {
        if (!(u >= 0 && u < 1)) return false;
    }
    return start.probability(lesson.emitter) > 0;
}

/// Lessons as second moments v²/density, which is what the variance is made of.
struct Weighted {
    const Lesson* lesson;
    double weight;
};

/// No lesson weighs more than a 32nd of all: one lucky photon must not draw the rest after it.
void limit(std::vector<Weighted>& lessons) {
    const std::size_t shares = std::min(k_fewest_shares, lessons.size() / 2);
    std::vector<double> weights(lessons.size()), largest(shares);
    for (std::size_t i = 0; i < lessons.size(); ++i) weights[i] = lessons[i].weight;
    std::partial_sort_copy(weights.begin(), weights.end(), largest.begin(), largest.end(), std::greater<>());
    double rest = 0;
    for (const double w : weights) rest += w;
    // With the `cut` largest cut down to the limit, all together are `shares` times the limit.
    double limit = rest;
    for (std::size_t cut = 0; cut < shares; ++cut) {
        limit = rest / static_cast<double>(shares - cut);
        if (largest[cut] <= limit) break;
        rest -= largest[cut];
    }
    for (Weighted& w : lessons) w.weight = std::min(w.weight, limit);
}

/// The same choice of lessons every time, and none of the photons' own patterns in it.
bool chosen(std::size_t index, double share) {
    std::uint64_t h = (index + 1) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 31) * 0xbf58476d1ce4e5b9u;
    return static_cast<double>(h >> 11) * 0x1p-53 < share;
}

/// Lessons grouped by emitter, in their order within each; a fixed choice where there are more than are worth the time.
std::vector<Weighted> by_emitter(const std::vector<Lesson>& lessons, const Pick& start) {
    const double share = static_cast<double>(k_most_lessons) / static_cast<double>(lessons.size());
    const auto root = [](const Lesson& l) {
        return static_cast<double>(l.value) / std::sqrt(static_cast<double>(l.density));
    };
    std::vector<const Lesson*> used;
    std::vector<std::uint32_t> next(start.size() + 1);
    double largest = 0;
    for (std::size_t i = 0; i < lessons.size(); ++i) {
        if ((share < 1 && !chosen(i, share)) || !usable(lessons[i], start)) continue;
        used.push_back(&lessons[i]);
        ++next[static_cast<std::size_t>(lessons[i].emitter) + 1];
        largest = std::max(largest, root(lessons[i]));
    }
    for (std::size_t e = 1; e < next.size(); ++e) next[e] += next[e - 1];
    std::vector<Weighted> sorted(used.size());
    for (const Lesson* l : used) {
        const double r = root(*l) / largest;
        sorted[next[static_cast<std::size_t>(l->emitter)]++] = {l, r * r};
    }
    limit(sorted);
    return sorted;
}

/// How many lessons the powers are worth as a forecast of `found`, the lessons of each emitter out of `count`: counts are Poisson
/// about gamma-distributed rates, whose spread is what they scatter beyond Poisson.
double prior_strength(const std::vector<double>& found, const Pick& start, double count) {
    double squares = 0, excess = 0;
    for (std::size_t e = 0; e < found.size(); ++e) {
        const double expected = count * start.probability(static_cast<std::int32_t>(e)), off = found[e] - expected;
        squares += expected * expected;
        excess += off * off - expected;
    }
    return excess > 0 ? std::clamp(squares / excess, k_weakest_prior, k_strongest_prior) : k_strongest_prior;
}

/// What the lessons of one emitter say.
struct Learned {
    CubeTree tree;
    float gain = 1;
};

}  // namespace

struct PhotonGuide::Storage {
    Pick start, guided;
    std::vector<std::int32_t> learned_of;  ///< by emitter, -1: nothing learned
    std::vector<Learned> learned;

    double cube_density(std::int32_t emitter, const float (&u)[k_cube]) const {
        const std::int32_t i = learned_of[static_cast<std::size_t>(emitter)];
        return i < 0 ? 1.0 : static_cast<double>(learned[static_cast<std::size_t>(i)].tree.density(u));
    }
    double mixed(std::int32_t emitter, double cube) const {
        return k_uniform * start.probability(emitter) + (1 - k_uniform) * guided.probability(emitter) * cube;
    }
    double density(std::int32_t emitter, const float (&u)[k_cube]) const {
        return guided.empty() ? start.probability(emitter) : mixed(emitter, cube_density(emitter, u));
    }
    void learn_trees(const std::vector<Weighted>& lessons);
    void set_gains(const std::vector<Weighted>& lessons);
};

PhotonGuide::PhotonGuide(std::vector<float> power) : storage_(std::make_unique<Storage>()) {
    storage_->start = Pick(std::vector<double>(power.begin(), power.end()));
}
PhotonGuide::~PhotonGuide() = default;
PhotonGuide::PhotonGuide(PhotonGuide&&) noexcept = default;
PhotonGuide& PhotonGuide::operator=(PhotonGuide&&) noexcept = default;

bool PhotonGuide::empty() const { return storage_->start.empty(); }

Emission PhotonGuide::draw(float choice, const float (&u)[k_cube]) const {
    const Storage& s = *storage_;
    Emission e;
    std::copy(std::begin(u), std::end(u), e.u);
    const auto c = static_cast<double>(choice);
    if (s.guided.empty()) {
        e.emitter = s.start.draw(c);
        e.density = static_cast<float>(s.start.probability(e.emitter));
        return e;
    }
    double cube = 1;
    if (c < k_uniform) {
        e.emitter = s.start.draw(c / k_uniform);
        cube = s.cube_density(e.emitter, e.u);
    } else {
        e.emitter = s.guided.draw((c - k_uniform) / (1 - k_uniform));
        const std::int32_t i = s.learned_of[static_cast<std::size_t>(e.emitter)];
        if (i >= 0) cube = static_cast<double>(s.learned[static_cast<std::size_t>(i)].tree.draw(e.u));
    }
    e.density = static_cast<float>(s.mixed(e.emitter, cube));
    return e;
}

float PhotonGuide::density(std::int32_t emitter, const float (&u)[k_cube]) const {
    return static_cast<float>(storage_->density(emitter, u));
}

/// Trees, and the probabilities of emitters.
void PhotonGuide::Storage::learn_trees(const std::vector<Weighted>& lessons) {
    // As many lessons as there would have been at the start's density, and their mean square contribution.
    double count = 0, square = 0, powers = 0;
    for (const Weighted& w : lessons) {
        count += start.probability(w.lesson->emitter) / static_cast<double>(w.lesson->density);
        square += w.weight;
    }
    for (std::size_t e = 0; e < start.size(); ++e) {
        const double p = start.probability(static_cast<std::int32_t>(e));
        powers += p * p;
    }
    square /= count * powers;

    std::vector<double> weight(start.size()), found(start.size());
    std::vector<Sample> samples;
    for (std::size_t begin = 0, end = 0; begin < lessons.size(); begin = end) {
        const std::int32_t emitter = lessons[begin].lesson->emitter;
        samples.clear();
        for (; end < lessons.size() && lessons[end].lesson->emitter == emitter; ++end) {
            weight[static_cast<std::size_t>(emitter)] += lessons[end].weight;
            found[static_cast<std::size_t>(emitter)] +=
                start.probability(emitter) / static_cast<double>(lessons[end].lesson->density);
            const float(&u)[k_cube] = lessons[end].lesson->u;
            samples.push_back({{u[0], u[1], u[2], u[3]}, static_cast<float>(lessons[end].weight)});
        }
        learned_of[static_cast<std::size_t>(emitter)] = static_cast<std::int32_t>(learned.size());
        learned.push_back({CubeTree(samples.data(), samples.size()), 1});
    }
    const double prior = prior_strength(found, start, count);
    for (std::size_t e = 0; e < weight.size(); ++e) {
        // Few lessons where few were to be expected say little: gamma prior on what emitters bring, in units of the mean. The
        // root of a gamma variable is smaller in the mean than the root of its mean, much so where it is 0 most of the time.
        const double p = start.probability(static_cast<std::int32_t>(e)), expected = count * p,
                     shape = found[e] + prior;
        const double moment = (weight[e] + prior * square * p) * expected / (expected + prior) * shape / (shape + 0.3);
        const double narrowed =
            learned_of[e] < 0 ? 1 : learned[static_cast<std::size_t>(learned_of[e])].tree.concentration();
        weight[e] = std::sqrt(moment) * narrowed;
    }
    guided = Pick(weight);
}

void PhotonGuide::Storage::set_gains(const std::vector<Weighted>& lessons) {
    for (std::size_t begin = 0, end = 0; begin < lessons.size(); begin = end) {
        const std::int32_t emitter = lessons[begin].lesson->emitter;
        auto& l = learned[static_cast<std::size_t>(learned_of[static_cast<std::size_t>(emitter)])];
        double sum = 0, weight = 0;
        for (; end < lessons.size() && lessons[end].lesson->emitter == emitter; ++end) {
            // Root of v²/density times that of 1/density: v/density, what the place adds to the picture.
            const double w = std::sqrt(lessons[end].weight / static_cast<double>(lessons[end].lesson->density));
            sum += w * mixed(emitter, l.tree.density_without(lessons[end].lesson->u, lessons[end].weight));
            weight += w;
        }
        const double gain = sum / weight / start.probability(emitter);
        l.gain = weight > 0 ? std::clamp(static_cast<float>(gain), 1.0f, k_most_gain) : 1.0f;
    }
}

void PhotonGuide::learn(const std::vector<Lesson>& lessons) {
    Storage& s = *storage_;
    s.guided = {};
    s.learned.clear();
    s.learned_of.assign(s.start.size(), -1);
    const std::vector<Weighted> sorted = by_emitter(lessons, s.start);
    if (sorted.empty()) return;
    s.learn_trees(sorted);
    if (!s.guided.empty()) s.set_gains(sorted);
}

float PhotonGuide::gain(std::int32_t emitter) const {
    const Storage& s = *storage_;
    if (emitter < 0 || static_cast<std::size_t>(emitter) >= s.learned_of.size()) return 1;
    const std::int32_t i = s.learned_of[static_cast<std::size_t>(emitter)];
    return i < 0 ? 1 : s.learned[static_cast<std::size_t>(i)].gain;
}

std::int64_t PhotonGuide::memory_bytes() const {
    const Storage& s = *storage_;
    std::size_t bytes = s.start.memory_bytes() + s.guided.memory_bytes() +
                        s.learned_of.capacity() * sizeof(std::int32_t) + s.learned.capacity() * sizeof(Learned);
    for (const Learned& l : s.learned) bytes += l.tree.memory_bytes();
    return static_cast<std::int64_t>(bytes);
}

}  // namespace cardioid::photon
