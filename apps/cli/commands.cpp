#include "commands.h"

#include <array>

#include "command.h"

namespace emca::cli {

std::span<const AddCommand> commands() {
    static constexpr std::array<AddCommand, 4> kCommands{addInfoCommand, addRenderCommand, addPixelCommand,
                                                         addLayersCommand};
    return kCommands;
}

}  // namespace emca::cli
