#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

#include "emca/server/renderer.h"
#include "emca/server/server_tool.h"
#include "request.h"

namespace emca {

/// What a renderer sees of the client for which it works.
class JobMonitor final : public RequestMonitor {
  public:
    JobMonitor(std::shared_ptr<Request> request, bool preview, std::vector<std::shared_ptr<ServerTool>> tools = {})
        : request_(std::move(request)), preview_(preview), tools_(std::move(tools)) {}

    bool cancelled() const override { return request_->cancelled.load(std::memory_order_relaxed); }
    void progress(double fraction) override;
    void preview(PixelRect rect, const std::vector<Color>& colors) override;
    void beginPixel(Pixel pixel) override;
    void endPixel(Pixel pixel) override;

  private:
    std::shared_ptr<Request> request_;
    bool preview_;
    std::vector<std::shared_ptr<ServerTool>> tools_;
    std::atomic<std::chrono::steady_clock::rep> lastSent_{0};
};

}  // namespace emca
