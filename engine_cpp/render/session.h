// SPDX-License-Identifier: GPL-3.0-or-later
// One render: a controller thread builds the scene and runs passes in a TBB arena of its own. The host polls; nothing calls
// back into it. The description may be shared by several sessions and is never changed.
#pragma once

#include "film/film.h"
#include "scene/scene_desc.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cardioid::render {

enum class Phase : std::uint8_t { waiting, build, render, done, cancelled, failed };
const char* phase_name(Phase phase);

/// A copied value: where the session stands.
struct Progress {
    Phase phase = Phase::waiting;
    double fraction = 0;  ///< of the samples; 0 while building
    int samples = 0, total_samples = 0;
    double elapsed = 0, remaining = 0;  ///< seconds since start(); estimate, 0 while unknown
    std::int64_t memory_bytes = 0;
    std::string message;         ///< stage, or the error
    std::uint64_t revision = 0;  ///< grows whenever the picture changed
    int passes = 0;              ///< of photons
    std::int64_t photons_emitted = 0, photons_stored = 0;
};

/// Facts about a finished (or running) render; JSON object as text, for logs and --cardioid-stats.
using StatsJson = std::string;

class Session {
public:
    /// `desc` has passed scene::validate. `width`: lanes, 0 for the best of this machine (tests choose).
    /// `notes`: what validation repaired; they stand first in warnings().
    explicit Session(std::shared_ptr<const scene::SceneDesc> desc, int width = 0, std::vector<std::string> notes = {});
    /// Cancels, filter runs too, and waits.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void start();
    /// True when the session has ended; waits at most `seconds`.
    bool wait(double seconds);
    /// Rendering stops soon (within a quarter of a second); the picture so far stays. With use_filter it is filtered once more
    /// before the session ends ("Filtering"), if that takes at most 5 s; the destructor does not wait for that.
    void cancel();
    Progress progress() const;
    /// A copy of the picture as it is now; null before the first tile.
    std::shared_ptr<const film::Frame> frame() const;
    /// What was rendered, to be filtered again or saved; stays valid after the session. Null before the session has ended, and
    /// where it failed or has rendered nothing.
    std::shared_ptr<const film::Film> film() const;
    std::vector<std::string> warnings() const;
    StatsJson stats() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Cores that settings.threads = 0 stands for.
int available_threads();

/// Version of the TBB library at run time.
std::string tbb_version();

}  // namespace cardioid::render
