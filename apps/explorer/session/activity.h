#pragma once

#include <QElapsedTimer>
#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "emca/client/connection.h"

namespace emca::explorer {

/// A request that is under way: written by the connection's thread, read by the GUI thread.
struct Activity {
    struct Tile {
        PixelRect rect;
        std::vector<Color> colors;
    };

    std::shared_ptr<std::atomic<bool>> cancel = std::make_shared<std::atomic<bool>>(false);
    std::atomic<double> fraction{-1};   ///< negative: not known yet
    QElapsedTimer clock;

    Activity() { clock.start(); }

    void addTile(PixelRect rect, std::span<const Color> colors) {
        const std::lock_guard lock(mutex_);
        tiles_.push_back({rect, {colors.begin(), colors.end()}});
    }
    std::vector<Tile> takeTiles() {
        const std::lock_guard lock(mutex_);
        return std::exchange(tiles_, {});
    }
    /// \param self  kept alive by the observer
    static client::RequestObserver observer(const std::shared_ptr<Activity>& self, bool preview = false) {
        client::RequestObserver observer;
        observer.cancel = self->cancel;
        observer.progress = [self](double fraction) { self->fraction = fraction; };
        if (preview)
            observer.preview = [self](PixelRect rect, std::span<const Color> colors) { self->addTile(rect, colors); };
        return observer;
    }

  private:
    std::mutex mutex_;
    std::vector<Tile> tiles_;
};

}  // namespace emca::explorer
