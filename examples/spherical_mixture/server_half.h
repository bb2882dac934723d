#pragma once

#include "emca/server/server_tool.h"

namespace mixture {

/// The half of the plugin that lives in the renderer: fits a mixture to the radiance that arrives at a vertex, for which it
/// asks the renderer's light probe, or to directions that it is given.
class MixtureTool final : public emca::ServerTool {
  public:
    std::string name() const override;
    void setHost(emca::ToolHost& host) override { host_ = &host; }
    bool observesReplay() const override { return false; }
    emca::Result<std::vector<std::byte>> answer(std::span<const std::byte> request, emca::RequestMonitor& monitor) override;

  private:
    emca::ToolHost* host_ = nullptr;
};

}  // namespace mixture
