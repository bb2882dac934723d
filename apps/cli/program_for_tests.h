#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "json.h"

namespace emca::cli {

/// What a finished program left.
struct Finished {
    int exitCode = -1;  ///< -1 if a signal ended it
    std::string out, err;
};

/// The built `emca` as a process of its own, in an empty folder that goes away.
class Program {
  public:
    Program() {
        std::string pattern = (std::filesystem::temp_directory_path() / "emca-cli-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    ~Program() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    std::filesystem::path file(const std::string& name) const { return folder_ / name; }

    /// Starts it; finish() must follow.
    pid_t start(const std::vector<std::string>& arguments) const {
        std::vector<std::string> words{EMCA_PROGRAM};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        const std::string out = file("out").string(), err = file("err").string(), folder = folder_.string();
        const pid_t child = ::fork();
        if (child == 0) {
            // Only calls that are safe between fork and exec.
            constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
            if (::chdir(folder.c_str()) != 0) ::_exit(126);
            ::dup2(::open(out.c_str(), kFlags, 0600), STDOUT_FILENO);
            ::dup2(::open(err.c_str(), kFlags, 0600), STDERR_FILENO);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        return child;
    }
    Finished finish(pid_t child) const {
        int status = 0;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out"), read("err")};
    }
    Finished run(const std::vector<std::string>& arguments) const { return finish(start(arguments)); }

  private:
    std::string read(const std::string& name) const {
        std::ifstream in(file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::filesystem::path folder_;
};

/// A test that runs the program and judges what it says.
class ProgramTest : public testing::Test {
  protected:
    Finished run(std::vector<std::string> arguments) { return program.run(arguments); }
    /// What it printed, where it had nothing to complain of.
    Json json(std::vector<std::string> arguments) {
        const Finished f = run(std::move(arguments));
        EXPECT_EQ(f.exitCode, Exit::ok) << f.err;
        EXPECT_EQ(f.err, "");
        return Json::parse(f.out, nullptr, false);
    }
    /// One sentence on standard error, nothing on standard output.
    void expectError(const std::vector<std::string>& arguments, int exitCode, const std::string& word) {
        const Finished f = run(arguments);
        SCOPED_TRACE(testing::PrintToString(arguments));
        EXPECT_EQ(f.exitCode, exitCode) << f.err;
        EXPECT_EQ(f.out, "");
        EXPECT_NE(f.err.find(word), std::string::npos) << f.err;
        EXPECT_EQ(f.err.find('\n'), f.err.size() - 1) << f.err;
    }
    Program program;
};

}  // namespace emca::cli
