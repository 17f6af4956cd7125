// SPDX-License-Identifier: GPL-3.0-or-later
// What is thrown when a description cannot be read, saved or rendered.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cardioid::scene {

/// what() is one readable line; problems() lists every message when there are several.
class SceneError : public std::runtime_error {
public:
    explicit SceneError(const std::string& message) : std::runtime_error(message), problems_{message} {}
    explicit SceneError(std::vector<std::string> problems)
        : std::runtime_error(problems.empty() ? "unknown error" : problems.front()), problems_(std::move(problems)) {}
    const std::vector<std::string>& problems() const { return problems_; }

private:
    std::vector<std::string> problems_;
};

}  // namespace cardioid::scene
