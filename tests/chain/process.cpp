#include "process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <utility>

namespace emca::test {
namespace {

using Clock = std::chrono::steady_clock;

pid_t start(const std::vector<std::string>& command, int out, int err) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

struct Pipe {
    Pipe() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) == 0) read = ends[0], write = ends[1];
    }
    void closeWrite() { close(std::exchange(write, -1)); }
    ~Pipe() {
        if (read >= 0) close(read);
        if (write >= 0) close(write);
    }
    int read = -1, write = -1;
};

/// Appends what there is; false at the end of the stream.
bool take(int descriptor, std::string& text) {
    std::array<char, 65536> buffer;
    const ssize_t n = read(descriptor, buffer.data(), buffer.size());
    if (n <= 0) return false;
    text.append(buffer.data(), std::size_t(n));
    return true;
}

}  // namespace

Outcome run(const std::vector<std::string>& command) {
    Pipe out, err;
    const pid_t child = start(command, out.write, err.write);
    out.closeWrite();
    err.closeWrite();
    Outcome outcome;
    const auto end = Clock::now() + std::chrono::minutes(2);
    std::array<pollfd, 2> polled{{{out.read, POLLIN, 0}, {err.read, POLLIN, 0}}};
    while ((polled[0].fd >= 0 || polled[1].fd >= 0) && Clock::now() < end) {
        poll(polled.data(), polled.size(), 1000);
        if (polled[0].revents && !take(polled[0].fd, outcome.out)) polled[0].fd = -1;
        if (polled[1].revents && !take(polled[1].fd, outcome.err)) polled[1].fd = -1;
    }
    if (Clock::now() >= end) kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

ServingProcess::ServingProcess(const std::vector<std::string>& command) {
    Pipe out;
    child_ = start(command, out.write, STDERR_FILENO);
    out.closeWrite();
    output_ = std::exchange(out.read, -1);
    std::string text;
    const auto end = Clock::now() + std::chrono::minutes(1);
    while (Clock::now() < end) {
        pollfd polled{output_, POLLIN, 0};
        poll(&polled, 1, 1000);
        if (polled.revents && !take(output_, text)) return;
        const std::size_t begin = text.find("listening on ");
        const std::size_t line = begin == std::string::npos ? begin : text.find('\n', begin);
        if (line == std::string::npos) continue;
        address_ = text.substr(begin + 13, line - begin - 13);
        return;
    }
}

ServingProcess::~ServingProcess() {
    if (child_ > 0) {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
    if (output_ >= 0) close(output_);
}

int ServingProcess::port() const { return std::atoi(address_.substr(address_.rfind(':') + 1).c_str()); }

bool ServingProcess::alive() const { return waitpid(child_, nullptr, WNOHANG) == 0; }

}  // namespace emca::test
