#pragma once

#include <CLI/CLI.hpp>

#include "arguments.h"

namespace emca::cli {

/// Declares --spp, --seed, --integrator and --sampler. `arguments` must live as long as the command.
inline void addSettingsOptions(CLI::App& command, SettingsArguments& arguments) {
    command.add_option("--spp", arguments.samples, "samples per pixel (default: the scene's)")->type_name("N");
    command.add_option("--seed", arguments.seed, "another seed gives another noise of the same image")->type_name("N");
    command.add_option("--integrator", arguments.integrator, "one that the renderer knows (default: the scene's)")
        ->type_name("NAME");
    command.add_option("--sampler", arguments.sampler, "one that the renderer knows (default: the scene's)")
        ->type_name("NAME");
}

/// Declares the positional HOST:PORT.
inline void addAddressOption(CLI::App& command, std::string& address) {
    command.add_option("address", address, "where the renderer listens; HOST and PORT default to 127.0.0.1 and 50013")
        ->required()
        ->type_name("HOST:PORT");
}

}  // namespace emca::cli
