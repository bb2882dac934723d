#pragma once

#include <QApplication>
#include <QPointer>
#include <QString>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace emca::explorer {

/// Stands around every call of a plugin: catches what it throws and tells who it was, and lets the watch know whose code
/// is running. There is one for the process, since events of all windows come through one QApplication.
///
/// What it cannot do: an exception in a thread that the plugin started itself, a crash and an endless loop end or block
/// the process whatever is done here. Those are what the probe before loading and the marks of PluginWatch are for.
class PluginGuard {
  public:
    using Slot = int;
    static constexpr Slot kNobody = -1;
    static constexpr int kSlots = 64, kNameBytes = 1024;

    static PluginGuard& instance();

    /// Takes part from now on. \param root  events of it and of everything below belong to the plugin
    /// \param failed  GUI thread, after an exception; must not delete `root` at once (it is still handling the event)
    /// \return kNobody if there are too many
    Slot add(QObject* root, const QString& file, std::function<void(const QString& what)> failed);
    void remove(Slot slot);

    /// Calls a plugin. \return false if it threw; `failed` was called then
    template <typename Call>
    bool run(Slot slot, Call call) {
        const Scope scope(*this, slot);
        try {
            call();
            return true;
        } catch (...) {
            report(slot);
            return false;
        }
    }

    /// The body of QApplication::notify. \param deliver  what Qt does; called once
    template <typename Deliver>
    bool notify(const QObject* receiver, Deliver deliver) {
        if (isEmpty()) return deliver();
        // The receiver may be gone after its event: who it belongs to is known before.
        const Slot owner = ownerOf(receiver), outer = current_.load();
        const Scope scope(*this, owner);
        try {
            return deliver();
        } catch (...) {
            report(owner != kNobody ? owner : outer);
            return true;
        }
    }
    /// Whom an object belongs to, by its parents.
    Slot ownerOf(const QObject* object) const;
    bool isEmpty() const { return count_ == 0; }
    /// Something threw that belongs to no plugin (a timer without a parent, or EMCA itself).
    void setUnknown(std::function<void(const QString& what)> unknown) { unknown_ = std::move(unknown); }

    /// Whose code runs while one lives; kNobody: EMCA's own, inside of a plugin's call.
    class Scope {
      public:
        Scope(PluginGuard& guard, Slot slot) : guard_(guard), before_(guard.current_.exchange(slot)) { guard_.stamp(); }
        ~Scope() {
            guard_.current_ = before_;
            guard_.stamp();
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        PluginGuard& guard_;
        Slot before_;
    };

    // For the watch, from any thread; `current` and `fileOf` also from a signal handler.
    Slot current() const { return idle_ ? kNobody : current_.load(); }
    std::chrono::nanoseconds since() const { return std::chrono::nanoseconds(since_.load()); }
    const char* fileOf(Slot slot) const { return slot >= 0 && slot < kSlots ? files_[slot] : ""; }
    /// The event loop waits, whoever called it: a menu that a plugin opened blocks nobody.
    void setIdle(bool idle) {
        idle_ = idle;
        stamp();
    }

  private:
    PluginGuard() = default;
    void report(Slot slot);
    void stamp() { since_ = std::chrono::steady_clock::now().time_since_epoch().count(); }

    struct Entry {
        const QObject* root = nullptr;
        std::function<void(const QString&)> failed;
    };
    Entry entries_[kSlots];
    char files_[kSlots][kNameBytes] = {};
    int count_ = 0, used_ = 0;   ///< plugins; slots up to the last one that was ever used
    std::function<void(const QString&)> unknown_;
    std::atomic<Slot> current_{kNobody};
    std::atomic<std::int64_t> since_{0};
    std::atomic<bool> idle_{false};
};

/// The application object: exceptions of plugins end at the event that caused them.
class GuardedApplication : public QApplication {
  public:
    GuardedApplication(int& argc, char** argv);
    bool notify(QObject* receiver, QEvent* event) override;
};

}  // namespace emca::explorer
