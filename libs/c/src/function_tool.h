#pragma once

#include <string>

#include "emca/server/server_tool.h"
#include "guard.h"

namespace emca::c {

/// A server tool that consists of functions.
class FunctionTool final : public ServerTool {
  public:
    /// \param functions  complete: checkedTool()
    explicit FunctionTool(const emca_tool& functions) : c_(functions), name_(functions.name) {}

    std::string name() const override { return name_; }
    void setHost(ToolHost& host) override;
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) override;
    bool observesReplay() const override;
    void beginPixel(Pixel pixel) override;
    void endPixel(Pixel pixel) override;
    void beginPath(Pixel pixel, std::int64_t sample) override;
    void endPath(Pixel pixel, std::int64_t sample) override;
    void beginVertex(std::int32_t depth) override;
    void endVertex(std::int32_t depth) override;

  private:
    const emca_tool c_;
    const std::string name_;
};

/// Copies the struct. Errors: invalidArgument (no name, no answer), versionMismatch.
Result<emca_tool> checkedTool(const emca_tool* given);

}  // namespace emca::c
