#include "commands.h"

#include "command.h"

namespace emca::cli {

std::span<const AddCommand> commands() {
    static constexpr AddCommand kCommands[] = {addInfoCommand, addRenderCommand, addPixelCommand, addScanCommand,
                                               addAssertCommand, addExportCommand, addLayersCommand,
                                               addOutliersCommand, addStatsCommand, addDiffCommand, addDoctorCommand};
    return kCommands;
}

}  // namespace emca::cli
