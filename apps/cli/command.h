#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "emca/client/connection.h"
#include "emca/core/result.h"

namespace CLI {
class App;
}

namespace emca::cli {

/// How the program ends (docs/command-line.md).
struct Exit {
    enum : int { ok = 0, assertionFalse = 1, usage = 2, input = 3, connection = 4, server = 5, interrupted = 130 };
};

/// input: what was asked for cannot be; connection: no sane answer came; server: the renderer failed.
int exitCodeOf(ErrorCode code);

/// Prints "error: " and the sentence on standard error.
/// \return the exit code
int fail(const Error& error);
int failUsage(const std::string& sentence);

/// What the chosen command does once all arguments are read. \return the exit code
using Run = std::function<int()>;

/// Declares a subcommand; if a person chooses it, sets `run`. A new command is a file with one of these and a line in
/// commands().
using AddCommand = void (*)(CLI::App& app, Run& run);
std::span<const AddCommand> commands();

/// Opens a connection to what a person typed. Errors besides Connection::open's: invalidArgument.
Result<std::unique_ptr<client::Connection>> connect(const std::string& address);

/// The whole program. \param arguments  without the program's name
int run(std::vector<std::string> arguments);

}  // namespace emca::cli
