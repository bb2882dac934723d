#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "request.h"

namespace emca {

/// Renders of whole images take minutes, and nobody knows how long tools take; all else should feel immediate.
enum class Lane : std::uint8_t { image = 0, interactive = 1, tool = 2 };
inline constexpr int kLanes = 3;

/// Runs requests in threads of its own, one per lane, or one for all lanes where a renderer does one thing at a time.
/// Clients take turns (round robin), so that one that asks much does not keep the others waiting.
class Scheduler {
  public:
    using Work = std::function<void(const std::shared_ptr<Request>&)>;

    /// \param separateLanes  whether requests of several lanes may run at the same time
    Scheduler(bool separateLanes, Work work);
    ~Scheduler() { stop(); }
    Scheduler(const Scheduler&) = delete;
    Scheduler& operator=(const Scheduler&) = delete;

    void add(Lane lane, std::shared_ptr<Request> request);
    /// Takes a request back. \return false if it runs already or was never there.
    bool withdraw(const std::shared_ptr<Request>& request);
    /// Forgets what a client has waiting; what runs must be cancelled by its flag.
    void removeClient(std::uint64_t client);
    /// A client that was congested reads again.
    void wake();
    /// Marks running requests as cancelled, forgets waiting ones and joins the threads.
    void stop();

  private:
    struct Queue {
        std::map<std::uint64_t, std::deque<std::shared_ptr<Request>>> waiting;  // by client
        std::uint64_t lastClient = 0;
        std::shared_ptr<Request> running;
    };
    void runQueue(Queue& queue);
    std::shared_ptr<Request> takeNext(Queue& queue);
    Queue& queueOf(Lane lane) { return *queues_[queues_.size() == 1 ? 0 : static_cast<std::size_t>(lane)]; }

    Work work_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool stopping_ = false;
    std::vector<std::unique_ptr<Queue>> queues_;
    std::vector<std::thread> threads_;
};

}  // namespace emca
