#include "commands.h"

#include <array>

#include "command.h"

namespace emca::cli {

std::span<const AddCommand> commands() {
    static constexpr std::array<AddCommand, 3> kCommands{addInfoCommand, addRenderCommand, addPixelCommand};
    return kCommands;
}

}  // namespace emca::cli
