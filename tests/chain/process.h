#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace emca::test {

struct Outcome {
    int exitCode = -1;  ///< 128 + signal if a signal ended it
    std::string out, err;
};

/// Runs a program to its end, at most two minutes.
Outcome run(const std::vector<std::string>& command);

/// A program that serves: started, and ended when this goes.
class ServingProcess {
  public:
    /// Waits for the line "listening on HOST:PORT"; address() is empty if it never came.
    explicit ServingProcess(const std::vector<std::string>& command);
    ~ServingProcess();
    ServingProcess(const ServingProcess&) = delete;
    ServingProcess& operator=(const ServingProcess&) = delete;

    const std::string& address() const { return address_; }
    int port() const;
    bool alive() const;

  private:
    pid_t child_ = -1;
    int output_ = -1;
    std::string address_;
};

}  // namespace emca::test
