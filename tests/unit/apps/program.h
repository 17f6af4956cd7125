// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a command line program: arguments in, exit code and output back.
#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace cardioid::test {

struct Finished {
    int code = -1;
    std::string output;  ///< both streams
};

/// Runs the program in the shell with the arguments as they stand.
inline Finished run_program(const char* program, const std::string& arguments) {
    Finished r;
    const std::string command = std::string("\"") + program + "\" " + arguments + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");  // NOLINT(bugprone-command-processor): own temporary paths
    if (!pipe) return r;
    std::array<char, 4096> buffer;
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) r.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return r;
}

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Fails with a line that has both words, without a picture and without a crash.
inline void expect_refusal(const Finished& r, const std::string& word, const std::string& other = "") {
    EXPECT_GT(r.code, 0);
    EXPECT_LT(r.code, 128) << "killed by a signal: " << r.output;
    EXPECT_NE(r.output.find(word), std::string::npos) << r.output;
    EXPECT_NE(r.output.find(other), std::string::npos) << r.output;
    EXPECT_EQ(r.output.find("terminate called"), std::string::npos) << r.output;
}

}  // namespace cardioid::test
