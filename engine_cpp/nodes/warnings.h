// SPDX-License-Identifier: GPL-3.0-or-later
// Messages for the artist, each subject once.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace cardioid::nodes {

class Warnings {
public:
    /// Keeps `message` unless something with the same key was said before.
    void add(const std::string& key, const std::string& message) {
        if (keys_.insert(key).second) messages_.push_back(message);
    }
    void add(const std::string& message) { add(message, message); }
    const std::vector<std::string>& messages() const { return messages_; }

private:
    std::set<std::string> keys_;
    std::vector<std::string> messages_;
};

}  // namespace cardioid::nodes
