// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/photon_stage.h"

#include "light/light_data.h"
#include "path/dimensions.h"
#include "photon/guide.h"
#include "render/clock.h"
#include "simd/denormals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace cardioid::render {

namespace {

/// Photons of a pass are kept to about this many by making passes small.
constexpr double k_most_photons = 2e6;
/// Photons for each camera path.
constexpr double k_photons_per_path = 0.5;

/// The least share of photons that the last few pixels of adaptive sampling keep.
constexpr double k_least_share = 0.125;

/// For lamps that camera paths never find: photons are everything. Finite, so that weights stay numbers.
constexpr float k_never_hit = 1e20f;

std::vector<float> emission_power(const light::LightData& lights) {
    return {lights.emission_power, lights.emission_power + lights.emitter_count};
}

/// Runs the index's jobs in the arena of the caller.
void in_parallel(void*, int n, void (*body)(void*, int), void* argument) {
    tbb::parallel_for(0, n, [=](int i) {
        const FlushDenormals guard;
        body(argument, i);
    });
}

/// Photons traced together end up next to each other, whatever thread traced them.
std::vector<photon::Photon> concatenate(std::vector<std::vector<photon::Photon>> batches) {
    std::size_t total = 0;
    for (const auto& b : batches) total += b.size();
    std::vector<photon::Photon> all;
    all.reserve(total);
    for (auto& b : batches) {
        all.insert(all.end(), b.begin(), b.end());
        b = {};
    }
    return all;
}

}  // namespace

struct PhotonStage::Impl {
    const trace::SceneView& view;
    std::unique_ptr<trace::SceneView> alone;  // after giving up
    film::Region region;
    path::TracePhotons kernel;
    path::Partition partition;
    photon::PhotonGuide guide;
    std::vector<float> start_power;      // probability of each emitter at the start
    std::vector<float> emitter_density;  // path::PhotonPass
    photon::PhotonMap map;
    path::PhotonPass pass;
    std::int64_t per_sample = 0;
    double share = 1;      // of them that are traced
    int most_samples = 8;  // of a pass
    std::uint32_t pass_seed = 0;
    std::unique_ptr<std::atomic<std::uint32_t>[]> gathered;
    std::vector<photon::Lesson> lessons;
    std::vector<photon::PixelStatistics> pixels;  // per-pixel schedule
    std::unique_ptr<BalanceMeter> meter;          // null: the number of photons is given
    PhotonStats stats;
    mutable std::mutex mutex;  // of stats
    bool active = false;

    Impl(const trace::TraceableScene& scene, const film::Region& r, path::TracePhotons k)
        : view(scene.view()),
          region(r),
          kernel(k),
          partition(path::make_partition(view.settings, view.has_casters)),
          guide(emission_power(*view.lights)) {}

    photon::Emission emission(std::uint32_t number) const;
    void learn_densities();
    void learn_guide();
    int count_samples() const;
    void balance(const Pass& pass, const path::Counters& work);
    /// Camera paths take all classes from here on.
    void give_up();
    std::vector<photon::Photon> trace(std::int64_t emitted, const std::function<PhotonWorker()>& worker,
                                      const std::atomic<bool>& stop);
};

photon::Emission PhotonStage::Impl::emission(std::uint32_t number) const {
    using namespace CD_ISA_NS;
    const BirthNumbers n = birth_numbers(pass_seed, Int::of_bits(number));
    const float u[photon::k_cube] = {n.point.x[0], n.point.y[0], n.direction.x[0], n.direction.y[0]};
    return guide.draw(n.choice[0], u);
}

void PhotonStage::Impl::learn_densities() {
    for (std::size_t e = 0; e < emitter_density.size(); ++e) {
        const bool hit = light::lobes_can_hit(*view.lights, static_cast<int>(e));
        emitter_density[e] = hit ? start_power[e] * guide.gain(static_cast<std::int32_t>(e)) : k_never_hit;
    }
}

std::vector<photon::Photon> PhotonStage::Impl::trace(std::int64_t emitted, const std::function<PhotonWorker()>& worker,
                                                     const std::atomic<bool>& stop) {
    const auto count = static_cast<std::size_t>((emitted + path::k_batch - 1) / path::k_batch);
    std::vector<std::vector<photon::Photon>> batches(count);
    tbb::parallel_for(
        std::size_t{0}, count,
        [&](std::size_t b) {
            if (stop) return;
            const FlushDenormals guard;
            const PhotonWorker w = worker();
            path::PhotonRequest request;
            request.scene = &view;
            request.guide = &guide;
            request.emitter_density = emitter_density.data();
            request.classes = partition.photons;
            request.first = static_cast<std::uint32_t>(b * path::k_batch);
            request.count = static_cast<int>(std::min<std::int64_t>(path::k_batch, emitted - request.first));
            request.seed = pass_seed;
            w.stored->resize(static_cast<std::size_t>(path::k_batch) * (view.settings.max_bounces + 1));
            request.stored = w.stored->data();
            const int stored = kernel(request, *w.scratch);
            batches[b].assign(w.stored->begin(), w.stored->begin() + stored);
        },
        tbb::simple_partitioner{});
    return concatenate(std::move(batches));
}

PhotonStage::PhotonStage(const trace::TraceableScene& scene, const film::Region& region, path::TracePhotons kernel)
    : impl_(std::make_unique<Impl>(scene, region, kernel)) {
    Impl& s = *impl_;
    const scene::Settings& settings = s.view.settings;
    s.active = s.partition.photons != 0 && s.view.has_lights && !s.guide.empty();
    // Nothing that photons could bring: camera paths keep all that they find.
    if (!s.active && settings.integrator != scene::IntegratorKind::photon_mapping) s.partition = {};
    if (!s.active) return;
    // In photon mapping nearly all light is the photons': nothing is to be balanced, and one a path served it best.
    const bool all_by_photons = settings.integrator == scene::IntegratorKind::photon_mapping;
    const double per_path = all_by_photons ? 1 : k_photons_per_path;
    const auto automatic = static_cast<std::int64_t>(per_path * settings.width * settings.height);
    s.per_sample = settings.photons > 0 ? settings.photons : std::max<std::int64_t>(automatic, 1);
    s.start_power = emission_power(*s.view.lights);
    double sum = 0;
    for (const float p : s.start_power) sum += static_cast<double>(p);
    for (float& p : s.start_power) p = static_cast<float>(static_cast<double>(p) / sum);
    s.emitter_density.resize(s.start_power.size());
    s.learn_densities();
    if (settings.radius_schedule == scene::RadiusSchedule::per_pixel)
        s.pixels.resize(static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height));
    else if (settings.photons == 0 && !all_by_photons)
        s.meter = std::make_unique<BalanceMeter>(region);
    s.most_samples = s.count_samples();
    s.stats.per_sample = s.per_sample;
}

PhotonStage::~PhotonStage() = default;

const trace::SceneView& PhotonStage::view() const { return impl_->alone ? *impl_->alone : impl_->view; }
const path::Partition& PhotonStage::partition() const { return impl_->partition; }
bool PhotonStage::active() const { return impl_->active; }
bool PhotonStage::has_state() const { return !impl_->pixels.empty(); }

int PhotonStage::most_samples() const { return impl_->most_samples; }

int PhotonStage::Impl::count_samples() const {
    if (!active) return 8;
    // One hit point a pass in the per-pixel schedule (thesis: two camera paths a pixel and pass).
    const int bound = pixels.empty() ? 8 : 2;
    const double fit = k_most_photons / static_cast<double>(per_sample);
    int most = 1;
    while (2 * most <= bound && 2 * most <= fit) most *= 2;
    return most;
}

void PhotonStage::thin(double share) {
    // Where camera paths of a pass cost a share f of what they did, the error falls fastest with sqrt(f) of the photons (balance.h).
    impl_->share = std::max(k_least_share, std::sqrt(share));
}

bool PhotonStage::trace(const Pass& pass, const std::function<PhotonWorker()>& worker, const std::atomic<bool>& stop) {
    Impl& s = *impl_;
    if (!s.active) {
        const std::lock_guard lock(s.mutex);
        ++s.stats.skipped_passes;
        return true;
    }
    const scene::Settings& settings = s.view.settings;
    const auto per_path =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<double>(s.per_sample) * s.share));
    const std::int64_t emitted = per_path * pass.size;
    const auto started = Clock::now();
    s.pass_seed = settings.seed * 0x9e3779b9u + static_cast<std::uint32_t>(pass.number) * 0x85ebca6bu + 0x51ed270bu;
    // Two maps never stand beside each other.
    s.map = {};
    std::vector<photon::Photon> photons = s.trace(emitted, worker, stop);
    if (stop) return false;
    const double trace_seconds = seconds_since(started);
    const auto indexing = Clock::now();
    const std::size_t stored = photons.size();
    s.map.build(std::move(photons), in_parallel, nullptr);
    s.pass = {};
    s.pass.map = s.map.view();
    s.pass.emitted = static_cast<float>(emitted);
    s.pass.per_path = static_cast<float>(per_path);
    s.pass.emitter_density = s.emitter_density.data();
    s.pass.radius = settings.photon_radius;
    const auto alpha = static_cast<double>(settings.radius_shrink);
    if (s.pixels.empty()) {
        s.pass.radius *= static_cast<float>(std::sqrt(photon::memoryless_scale(pass.middle(), alpha)));
    } else {
        s.pass.pixels = s.pixels.data();
        s.pass.x = s.region.x;
        s.pass.y = s.region.y;
        s.pass.stride = s.region.width;
        s.pass.sample = pass.first;
        s.pass.alpha = settings.radius_shrink;
    }
    if (pass.number < k_training_passes && settings.guided_emission) {
        s.gathered = std::make_unique<std::atomic<std::uint32_t>[]>(std::max<std::size_t>(stored, 1));
        s.pass.gathered = s.gathered.get();
    }
    const std::lock_guard lock(s.mutex);
    ++s.stats.passes;
    s.stats.emitted += emitted;
    s.stats.stored += static_cast<std::int64_t>(stored);
    s.stats.trace_seconds += trace_seconds;
    s.stats.index_seconds += seconds_since(indexing);
    s.stats.bytes = std::max(s.stats.bytes, s.map.memory_bytes() + s.guide.memory_bytes() +
                                                static_cast<std::int64_t>(s.pixels.size() * sizeof(s.pixels[0])));
    return true;
}

const path::PhotonPass* PhotonStage::gather() const { return impl_->active ? &impl_->pass : nullptr; }

BalanceMeter* PhotonStage::meter(const Pass& pass) {
    return pass.number < k_training_passes ? impl_->meter.get() : nullptr;
}

void PhotonStage::Impl::balance(const Pass& p, const path::Counters& work) {
    if (!meter || p.number + 1 != k_training_passes) return;
    // In camera rays, measured on three scenes: photons scatter widely, are stored and sorted; a query costs even where it finds
    // nothing.
    const double photon_cost = 2.5 * static_cast<double>(work.photon_rays) + 0.7 * static_cast<double>(stats.stored) +
                               static_cast<double>(work.evaluated) / 8 + static_cast<double>(work.gathered) / 64;
    const double camera_cost = static_cast<double>(work.rays) + static_cast<double>(work.shadow_rays);
    const double factor = meter->factor(camera_cost, 0.5 * static_cast<double>(work.gathers), photon_cost);
    meter.reset();
    if (factor > 0) {
        const double wanted = static_cast<double>(per_sample) * factor;
        per_sample = static_cast<std::int64_t>(std::clamp(wanted, 1.0, k_most_photons / most_samples));
    } else {
        give_up();
    }
}

void PhotonStage::Impl::give_up() {
    active = false;
    per_sample = 0;
    partition = {};
    map = {};
    // As path tracing: only deltas are specular, and all else is connected to lamps.
    alone = std::make_unique<trace::SceneView>(view);
    alone->settings.caustic_roughness = 0;
    const std::lock_guard lock(mutex);
    stats.given_up = true;
}

void PhotonStage::learn(const Pass& pass, const path::Counters& work) {
    Impl& s = *impl_;
    if (!s.active || pass.number >= k_training_passes) return;
    const auto started = Clock::now();
    if (s.pass.gathered) s.learn_guide();
    s.balance(pass, work);
    if (pass.number + 1 == k_training_passes) s.lessons = {};
    const std::lock_guard lock(s.mutex);
    ++s.stats.training_passes;
    s.stats.per_sample = s.per_sample;
    s.stats.learn_seconds += seconds_since(started);
}

void PhotonStage::Impl::learn_guide() {
    for (std::int64_t i = 0; i < pass.map.count; ++i) {
        const std::uint32_t times = gathered[static_cast<std::size_t>(i)].load(std::memory_order_relaxed);
        if (times == 0) continue;
        const photon::Photon& q = pass.map.photons[i];
        const photon::Emission e = emission(q.source);
        photon::Lesson lesson;
        lesson.emitter = e.emitter;
        std::copy(std::begin(e.u), std::end(e.u), lesson.u);
        // The root: what is to be small is the sum of the pixels' variances, not of their means.
        lesson.value = std::sqrt(static_cast<float>(times)) *
                       std::fabs(path::luminance(q.flux[0], q.flux[1], q.flux[2])) * e.density;
        lesson.density = e.density;
        lessons.push_back(lesson);
    }
    guide.learn(lessons);
    learn_densities();
    gathered.reset();
}

void PhotonStage::store(const film::Region& part, film::Film& film) const {
    const Impl& s = *impl_;
    if (s.pixels.empty()) return;
    const auto emitted = static_cast<double>(stats().emitted);
    for (int y = part.y - s.region.y; y < part.y - s.region.y + part.height; ++y) {
        for (int x = part.x - s.region.x; x < part.x - s.region.x + part.width; ++x) {
            const photon::PixelStatistics& p = s.pixels[static_cast<std::size_t>(y) * s.region.width + x];
            if (p.radius <= 0) continue;
            const double area = 3.14159265358979 * static_cast<double>(p.radius) * static_cast<double>(p.radius);
            const auto scale = static_cast<float>(1 / (emitted * area));
            float means[film::k_classes - 1][3];
            for (int c = 0; c < photon::k_photon_classes; ++c) {
                for (int k = 0; k < 3; ++k) means[c][k] = p.tau[c][k] * scale;
            }
            film.set_photons(x, y, means);
        }
    }
}

PhotonStats PhotonStage::stats() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->stats;
}

}  // namespace cardioid::render
