#include "plugin/plugin_guard.h"

#include <QAbstractEventDispatcher>
#include <QThread>
#include <cstring>
#include <exception>

namespace emca::explorer {
namespace {

QString words(const std::exception_ptr& thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
        return QString::fromUtf8(error.what());
    } catch (...) {
        return QObject::tr("something that is no std::exception");
    }
}

}  // namespace

PluginGuard& PluginGuard::instance() {
    static PluginGuard guard;
    return guard;
}

PluginGuard::Slot PluginGuard::add(QObject* root, const QString& file, std::function<void(const QString&)> failed) {
    for (Slot slot = 0; slot < kSlots; ++slot) {
        if (entries_[slot].root) continue;
        const QByteArray name = file.toUtf8().left(kNameBytes - 1);
        std::memcpy(files_[slot], name.constData(), std::size_t(name.size()) + 1);
        entries_[slot] = {root, std::move(failed)};
        ++count_;
        return slot;
    }
    return kNobody;
}

void PluginGuard::remove(Slot slot) {
    if (slot < 0 || slot >= kSlots || !entries_[slot].root) return;
    entries_[slot] = {};
    --count_;
}

PluginGuard::Slot PluginGuard::ownerOf(const QObject* object) const {
    for (; object; object = object->parent())
        for (Slot slot = 0; slot < kSlots; ++slot)
            if (entries_[slot].root == object) return slot;
    return kNobody;
}

void PluginGuard::report(Slot slot) {
    const QString what = words(std::current_exception());
    // A copy: the plugin may be started again meanwhile.
    const auto tell = slot == kNobody ? unknown_ : entries_[slot].failed;
    if (tell) tell(what);
}

bool PluginGuard::notify(QObject* receiver, QEvent* event, const std::function<bool()>& deliver) {
    if (count_ == 0) return deliver();
    const Slot owner = ownerOf(receiver), outer = current_.load();
    const Scope scope(*this, owner);
    // The receiver may be gone after its event; who it was is known before.
    Q_UNUSED(event);
    try {
        return deliver();
    } catch (...) {
        report(owner != kNobody ? owner : outer);
        return true;
    }
}

GuardedApplication::GuardedApplication(int& argc, char** argv) : QApplication(argc, argv) {
    if (auto* dispatcher = QAbstractEventDispatcher::instance()) {
        connect(dispatcher, &QAbstractEventDispatcher::aboutToBlock, this, [] { PluginGuard::instance().setIdle(true); });
        connect(dispatcher, &QAbstractEventDispatcher::awake, this, [] { PluginGuard::instance().setIdle(false); });
    }
}

bool GuardedApplication::notify(QObject* receiver, QEvent* event) {
    if (PluginGuard::instance().isEmpty() || QThread::currentThread() != thread()) return QApplication::notify(receiver, event);
    return PluginGuard::instance().notify(receiver, event, [&] { return QApplication::notify(receiver, event); });
}

}  // namespace emca::explorer
