#include "plugin/plugin_guard.h"

#include <QAbstractEventDispatcher>
#include <QThread>
#include <algorithm>
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
        used_ = std::max(used_, slot + 1);
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
        for (Slot slot = 0; slot < used_; ++slot)
            if (entries_[slot].root == object) return slot;
    return kNobody;
}

void PluginGuard::report(Slot slot) {
    const QString what = words(std::current_exception());
    // A copy: the plugin may be started again meanwhile.
    const auto tell = slot == kNobody ? unknown_ : entries_[slot].failed;
    if (tell) tell(what);
}

GuardedApplication::GuardedApplication(int& argc, char** argv) : QApplication(argc, argv) {
    if (auto* dispatcher = QAbstractEventDispatcher::instance()) {
        connect(dispatcher, &QAbstractEventDispatcher::aboutToBlock, this, [] { PluginGuard::instance().setIdle(true); });
        connect(dispatcher, &QAbstractEventDispatcher::awake, this, [] { PluginGuard::instance().setIdle(false); });
    }
}

bool GuardedApplication::notify(QObject* receiver, QEvent* event) {
    if (QThread::currentThread() != thread()) return QApplication::notify(receiver, event);
    return PluginGuard::instance().notify(receiver, [&] { return QApplication::notify(receiver, event); });
}

}  // namespace emca::explorer
