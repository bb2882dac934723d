#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <deque>
#include <memory>
#include <optional>

#include "base/listeners.h"
#include "emca/client/connection.h"
#include "emca/client/session.h"
#include "session/activity.h"
#include "session/workers.h"

namespace emca::explorer {

enum class LinkState { offline, connecting, connected, reconnecting };

/// What a failure was about, so that the window can offer the right way on.
enum class FailedTask { connect, render, trace, scene, surface, openImage, saveImage, openSession, saveSession };

/// What one renderer said about a scene holds for what the other shows.
bool sameScene(const client::ServerInfo& a, const client::ServerInfo& b);

/// Everything between the models and the renderer: owns the connection, runs all requests and file access in other
/// threads and puts what arrives into Dataset. GUI thread; no function blocks.
///
/// A pixel or a region that becomes selected is traced: from the history at once if it was traced for the same image, else
/// by one request. The latest choice wins; an earlier request is cancelled. A region with very many paths waits for a word. A connection that is lost is opened again with
/// growing pauses; images and traces stay, the scene is loaded anew.
class SessionController : public QObject {
    Q_OBJECT
  public:
    SessionController(client::Dataset& dataset, client::Selection& selection, QObject* parent = nullptr);
    ~SessionController() override;

    LinkState link() const { return link_; }
    const client::Address& address() const { return address_; }
    /// Null while none is open. Requests on it block: from other threads only.
    std::shared_ptr<client::Connection> connection() const { return connection_; }
    /// Render as soon as a renderer is connected and no image of its size is there.
    void setRenderOnConnect(bool render) { renderOnConnect_ = render; }
    /// What that render is made with.
    void setRenderOptions(const client::RenderOptions& options) { renderOptions_ = options; }

    bool isRendering() const { return render_ != nullptr; }
    bool isTracing() const { return trace_ != nullptr; }
    bool isLoadingScene() const { return scene_ != nullptr; }
    /// Surface layers of a finished render are on their way.
    bool isFetchingLayers() const { return finished_ || layers_; }
    bool isReadingFile() const { return filesBeingRead_ > 0; }
    bool isOpeningSession() const { return opening_ != nullptr; }
    bool isSavingSession() const { return saving_ != nullptr; }
    /// Of the session that is opened or saved; negative: not known yet.
    double sessionFraction() const { return saving_ ? saving_->fraction.load() : opening_ ? opening_->fraction.load() : 0; }
    /// What a person wrote, here or into the session that was opened last; saved with the next one.
    const std::string& notes() const { return notes_; }
    void setNotes(std::string notes);
    /// By pixel, row by row; none is empty.
    const std::vector<client::PixelNote>& pixelNotes() const { return pixelNotes_; }
    /// Empty if there is none.
    const std::string& pixelNote(Pixel pixel) const;
    /// \param text  empty: there is no note any more
    void setPixelNote(Pixel pixel, std::string text);
    /// What was asked of the paths; saved with the next session, and what the last one that was opened held.
    const std::optional<client::SavedFilter>& filter() const { return filter_; }
    void setFilter(const client::SavedFilter& filter) { filter_ = filter == client::SavedFilter() ? std::nullopt : std::optional(filter); }
    /// How the session that was opened last was looked at; nothing if it does not say.
    const std::optional<client::SavedView>& view() const { return view_; }
    /// Asked when a session is saved, about the Dataset as it is then. Its reference is an index into the Dataset's images.
    void setViewSource(std::function<client::SavedView()> source) { viewSource_ = std::move(source); }
    /// The image that connecting has rendered, so that nobody asked for it; null if none.
    std::shared_ptr<const RenderedImage> automaticImage() const { return automaticImage_.lock(); }
    /// Nothing is under way and nothing is waiting for a connection.
    bool isIdle() const;
    double renderFraction() const { return render_ ? render_->fraction.load() : 0; }
    double traceFraction() const { return trace_ ? trace_->fraction.load() : 0; }
    double traceSeconds() const { return trace_ ? double(trace_->clock.elapsed()) / 1000 : 0; }
    double sceneFraction() const { return scene_ ? scene_->fraction.load() : 0; }
    /// Empty if nothing is traced.
    const client::PixelRegion& tracedPixels() const { return tracing_; }
    /// A region with more paths is traced by traceAgain() only: a person may have wanted the numbers of its pixels.
    static constexpr std::uint64_t kUnaskedPaths = 1u << 16;
    /// How many paths the selected region has, if it waits for traceAgain(); else 0.
    std::uint64_t heldBack() const { return heldBack_; }
    /// With a query regions bring only the paths that it takes, as the renderer says (docs/queries.md); empty: all.
    const std::string& regionQuery() const { return regionQuery_; }
    void setRegionQuery(const std::string& query);
    /// "pixel (12, 34) in 23.10 ms, renderer 17.00 ms"; empty before the first request.
    const QString& lastRequest() const { return lastRequest_; }

  public slots:
    void connectTo(const emca::client::Address& address, const QString& token = {});
    void disconnectFromRenderer();
    void retryNow();
    /// Zero samples: the scene's. A render that runs is cancelled first. Layers it asks for are collected meanwhile and
    /// come into the Dataset together with the image; a render without layers keeps those that are there. The one word
    /// "all" in the place of names: every layer that the renderer offers.
    void render(const emca::client::RenderOptions& options);
    void cancelRender();
    /// Asks again, also where the history has a reply.
    void traceAgain();
    void cancelTrace();
    void reloadScene();
    void openImage(const QString& file);
    /// Reads a file that the current image shall be compared with: it becomes one of the images, but not the current one.
    void openReference(const QString& file);
    void saveImage(const QString& file);
    /// Puts a session in the place of everything that is here. The connection stays if its renderer shows the same
    /// scene. Until the file is read nothing changes, nor if it cannot be read; a later call replaces an earlier one.
    void openSession(const QString& file);
    /// Everything as it is now. Does nothing while another one is saved.
    void saveSession(const QString& file);
    void cancelSession();
    /// Shows a trace of the history and selects its pixel.
    void showTrace(std::shared_ptr<const emca::client::Trace> trace);

  signals:
    void linkChanged();
    /// Something began, ended or made progress.
    void activityChanged();
    void renderFinished();
    void traceFinished();
    void notesChanged();
    void imageOpened(const QString& file);
    void referenceOpened(const std::shared_ptr<const emca::RenderedImage>& reference);
    void imageSaved(const QString& file);
    /// \param complete  every part of the file was read
    void sessionOpened(const QString& file, bool complete, const QStringList& notices);
    /// \param saved  false: it failed or was cancelled
    void sessionSaveEnded(const QString& file, bool saved);
    void failed(emca::explorer::FailedTask task, const QString& sentence);

  private:
    struct Opened;
    void open();
    void opened(std::uint64_t generation, Result<Opened> result);
    void adopt(Opened opened);
    void lost(std::uint64_t generation, const Error& error);
    void scheduleRetry(const QString& reason);
    void setLink(LinkState link);
    void drop();
    void fail(FailedTask task, const Error& error);

    void ensureTraced(bool quietly);
    void trace(const client::PixelRegion& pixels);
    struct Known;
    void traced(std::shared_ptr<Activity> activity, Known asked, Result<client::Trace> result);
    void present(std::vector<std::shared_ptr<const client::Trace>> traces, bool fresh);
    std::shared_ptr<const client::Trace> knownTrace(const client::PixelRegion& pixels) const;
    std::shared_ptr<const client::Trace> storedTrace(const client::PixelRegion& pixels, bool exactly) const;
    bool showStored(const client::PixelRegion& pixels, bool quietly);
    std::string queryFor(const client::PixelRegion& pixels) const { return pixels.size() > 1 ? regionQuery_ : std::string(); }
    std::uint64_t pathsOf(const client::PixelRegion& pixels) const;
    void showSession(client::Session session);
    /// Why pixels of the current image cannot be traced, or empty.
    QString obstacle(const client::PixelRegion& pixels) const;
    client::TraceOptions traceOptions(const client::PixelRegion& pixels) const;

    void rendered(const std::shared_ptr<Activity>& activity, bool withLayers, Result<client::Render> result);
    void completeRender(std::optional<Result<SurfaceField>> surface);
    void abandonRender(const Error& error);
    std::optional<client::RenderOptions> withNamedLayers(client::RenderOptions options);
    void fetchLayers();
    void drainPreview();
    void loadScene();
    void forgetRenderIds();
    void begin();
    void readImage(const QString& file, bool asReference);
    std::optional<std::size_t> indexOf(const std::shared_ptr<const RenderedImage>& image) const;

    client::Dataset& dataset_;
    client::Selection& selection_;

    LinkState link_ = LinkState::offline;
    client::Address address_;
    QString token_;
    std::shared_ptr<client::Connection> connection_;
    std::uint64_t generation_ = 0;      ///< counts connections: what an earlier one still delivers is dropped
    int attempt_ = 0;
    QTimer retry_;
    bool renderOnConnect_ = true;

    std::shared_ptr<Activity> render_, trace_, scene_, layers_, opening_, saving_;
    std::optional<client::Render> finished_;   ///< complete, waiting for its layers
    std::shared_ptr<RenderedImage> preview_;
    client::RenderOptions renderOptions_;
    int renderCount_ = 0, filesBeingRead_ = 0;
    bool rendersUnasked_ = false;       ///< the render that runs was begun by connecting
    std::weak_ptr<const RenderedImage> automaticImage_;
    std::string notes_;
    std::vector<client::PixelNote> pixelNotes_;
    std::optional<client::SavedFilter> filter_;
    std::optional<client::SavedView> view_;
    std::function<client::SavedView()> viewSource_;
    bool showing_ = false;              ///< a session comes: its selection asks for no traces
    client::PixelRegion tracing_;
    std::string regionQuery_;
    std::uint64_t heldBack_ = 0;
    QTimer progress_;
    double shownProgress_ = -1;         ///< what the last activityChanged was about
    QString lastRequest_;

    struct Known {
        client::PixelRegion pixels;
        const RenderedImage* image;     ///< only compared
        std::string query;
        std::weak_ptr<const client::Trace> trace;   ///< as long as the history holds it
    };
    std::deque<Known> known_;

    Workers workers_;
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer

Q_DECLARE_METATYPE(emca::explorer::FailedTask)
