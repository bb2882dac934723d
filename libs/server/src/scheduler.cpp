#include "scheduler.h"

#include <algorithm>
#include <utility>

namespace emca {

Scheduler::Scheduler(bool separateLanes, Work work) : work_(std::move(work)) {
    for (int i = 0; i < (separateLanes ? kLanes : 1); ++i) queues_.push_back(std::make_unique<Queue>());
    for (auto& queue : queues_) threads_.emplace_back([this, &queue = *queue] { runQueue(queue); });
}

void Scheduler::add(Lane lane, std::shared_ptr<Request> request) {
    {
        const std::lock_guard lock(mutex_);
        if (stopping_) return;
        queueOf(lane).waiting[request->client->id()].push_back(std::move(request));
    }
    changed_.notify_all();
}

bool Scheduler::withdraw(const std::shared_ptr<Request>& request) {
    const std::lock_guard lock(mutex_);
    for (auto& queue : queues_) {
        const auto client = queue->waiting.find(request->client->id());
        if (client != queue->waiting.end() && std::erase(client->second, request) > 0) return true;
    }
    return false;
}

void Scheduler::removeClient(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    for (auto& queue : queues_) queue->waiting.erase(client);
}

void Scheduler::wake() {
    // Without the lock a worker could miss it between its look at the client and its wait.
    { const std::lock_guard lock(mutex_); }
    changed_.notify_all();
}

void Scheduler::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        for (auto& queue : queues_) {
            queue->waiting.clear();
            if (queue->running) queue->running->cancelled = true;
        }
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
}

std::shared_ptr<Request> Scheduler::takeNext(Queue& queue) {
    const auto ready = [](const auto& entry) { return !entry.second.empty() && !entry.second.front()->client->congested(); };
    // The next client after the one served last, in the order in which they came, begins anew after the last.
    const auto middle = queue.waiting.upper_bound(queue.lastClient);
    auto next = std::find_if(middle, queue.waiting.end(), ready);
    if (next == queue.waiting.end()) {
        next = std::find_if(queue.waiting.begin(), middle, ready);
        if (next == middle) return nullptr;
    }
    queue.lastClient = next->first;
    auto request = std::move(next->second.front());
    next->second.pop_front();
    if (next->second.empty()) queue.waiting.erase(next);
    return request;
}

void Scheduler::runQueue(Queue& queue) {
    std::unique_lock lock(mutex_);
    for (;;) {
        std::shared_ptr<Request> request;
        changed_.wait(lock, [&] { return stopping_ || (request = takeNext(queue)) != nullptr; });
        if (!request) return;
        queue.running = request;
        request->running = true;
        lock.unlock();
        work_(request);
        lock.lock();
        queue.running.reset();
    }
}

}  // namespace emca
