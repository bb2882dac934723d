#pragma once

#include <memory>
#include <string>

#include "emca/client/connection.h"
#include "emca/explorer/plugin_context.h"

namespace emca::explorer {

/// What the window does for plugins; knows nothing of the 3D view and the session itself. GUI thread.
class PluginServices {
  public:
    virtual ~PluginServices() = default;
    /// \param owner  the plugin's id
    virtual Result<void> setObject(const std::string& owner, const std::string& id, SceneObject object) = 0;
    virtual void removeObject(const std::string& owner, const std::string& id) = 0;
    virtual void removeObjects(const std::string& owner) = 0;
    virtual Subscription onPick(const std::string& owner, std::function<void(const std::string&, std::size_t)> picked) = 0;
    /// Null if no renderer is connected.
    virtual std::shared_ptr<client::Connection> connection() = 0;
    virtual void say(const QString& sentence) = 0;
    virtual void sayError(const QString& sentence) = 0;
};

}  // namespace emca::explorer
