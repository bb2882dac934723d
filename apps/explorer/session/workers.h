#pragma once

#include <QMetaObject>
#include <QObject>
#include <QRunnable>
#include <QThreadPool>
#include <memory>
#include <utility>

namespace emca::explorer {

/// Runs work in other threads and hands its result to the GUI thread. Destruction waits for what still runs; results
/// that arrive afterwards are dropped with their receiver.
class Workers {
  public:
    /// \param home  lives in the GUI thread and outlives this object
    explicit Workers(QObject& home) : home_(home) {
        // Threads wait for the network most of the time, so there may be more of them than processors.
        pool_.setMaxThreadCount(12);
    }
    ~Workers() { pool_.waitForDone(); }

    /// \param work  called in another thread; \param done  called with its result in the GUI thread
    template <typename Work, typename Done>
    void run(Work work, Done done) {
        pool_.start(QRunnable::create([this, work = std::move(work), done = std::move(done)]() mutable {
            auto result = std::make_shared<decltype(work())>(work());
            QMetaObject::invokeMethod(&home_, [result, done = std::move(done)]() mutable { done(std::move(*result)); },
                                      Qt::QueuedConnection);
        }));
    }

    /// Work without a result.
    template <typename Work>
    void start(Work work) {
        pool_.start(QRunnable::create(std::move(work)));
    }

  private:
    QObject& home_;
    QThreadPool pool_;
};

}  // namespace emca::explorer
