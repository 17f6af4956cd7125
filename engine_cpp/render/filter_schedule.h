// SPDX-License-Identifier: GPL-3.0-or-later
// When a picture in work is filtered again: at growing intervals, and never for more than a share of the time.
#pragma once

namespace cardioid::render {

class FilterSchedule {
public:
    static constexpr double k_share = 0.1;  ///< of the render's time
    /// Seconds that the host waits for a run after a cancel; beyond, the picture keeps the run before.
    static constexpr double k_affordable = 5;

    /// At once for the first time; then when samples have doubled, if another run as long as the last leaves the share kept.
    bool due(int samples, double elapsed) const {
        if (runs_ == 0) return samples > 0;
        return samples >= 2 * samples_ && seconds_ + last_ <= k_share * elapsed;
    }
    void ran(int samples, double seconds) {
        ++runs_;
        samples_ = samples;
        last_ = seconds;
        seconds_ += seconds;
    }
    int runs() const { return runs_; }
    double seconds() const { return seconds_; }
    double last_seconds() const { return last_; }
    bool affordable_after_cancel() const { return last_ <= k_affordable; }

private:
    int runs_ = 0, samples_ = 0;
    double seconds_ = 0, last_ = 0;
};

}  // namespace cardioid::render
