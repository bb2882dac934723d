#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace emca::client {

/// Calls every listener with the parts that changed. A listener may add and remove listeners, itself among them, and
/// may change the model again: who was removed is not called any more, who was added hears of the next change, and a
/// change made meanwhile is told in a further round, so that every listener hears of changes in the same order.
///
/// \param pending    parts that changed and were not told yet
/// \param notifying  true while a round runs further up the stack, which will tell them
template <typename Id, typename Listener>
void notifyListeners(std::vector<std::pair<Id, Listener>>& listeners, std::uint32_t& pending, bool& notifying) {
    if (notifying) return;
    struct Guard {  // also when a listener throws
        bool& flag;
        explicit Guard(bool& f) : flag(f) { flag = true; }
        ~Guard() { flag = false; }
    } guard(notifying);
    while (pending != 0) {
        const std::uint32_t parts = std::exchange(pending, 0);
        std::vector<Id> ids;
        ids.reserve(listeners.size());
        for (const auto& entry : listeners) ids.push_back(entry.first);
        for (const Id id : ids) {
            const auto it = std::find_if(listeners.begin(), listeners.end(), [id](auto& e) { return e.first == id; });
            if (it == listeners.end()) continue;
            const Listener listener = it->second;  // a copy: it may remove itself while it runs
            listener(parts);
        }
    }
}

}  // namespace emca::client
