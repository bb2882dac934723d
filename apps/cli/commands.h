#pragma once

#include "command.h"

// One subcommand each, in the file of its name.
namespace emca::cli {

void addInfoCommand(CLI::App& app, Run& run);
void addRenderCommand(CLI::App& app, Run& run);
void addPixelCommand(CLI::App& app, Run& run);
void addScanCommand(CLI::App& app, Run& run);
void addAssertCommand(CLI::App& app, Run& run);
void addExportCommand(CLI::App& app, Run& run);
void addOutliersCommand(CLI::App& app, Run& run);
void addStatsCommand(CLI::App& app, Run& run);
void addDiffCommand(CLI::App& app, Run& run);
void addLayersCommand(CLI::App& app, Run& run);
void addDoctorCommand(CLI::App& app, Run& run);

}  // namespace emca::cli
