#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/client/connection.h"
#include "emca/client/dataset.h"
#include "emca/client/selection.h"
#include "emca/core/result.h"

/// Sessions: everything that was received and what a person made of it, as one file (.emca; docs/sessions.md).
namespace emca::client {

/// What a person wrote about a pixel.
struct PixelNote {
    Pixel pixel;
    std::string text;
    friend bool operator==(const PixelNote&, const PixelNote&) = default;
};

/// What a person asked of the paths: rules, and the query that is in force (docs/queries.md). Rules are kept as they were
/// written, whether or not they are complete.
struct SavedFilter {
    struct Rule {
        std::string quantity;
        std::uint8_t over = 0, operation = 0;   ///< numbers of query::Quantifier and query::RuleOperator
        std::string value;
        friend bool operator==(const Rule&, const Rule&) = default;
    };
    std::string query;
    std::vector<Rule> rules;
    bool byHand = false;       ///< the query was edited: it is not what the rules say
    bool automatic = false;    ///< applied to each new pixel
    friend bool operator==(const SavedFilter&, const SavedFilter&) = default;
};

/// How a session was looked at: what was compared with what, and what was drawn.
struct SavedView {
    struct Option {
        std::string name, value;   ///< of the program that looked ("scene/clipAxis" "2"); others leave it alone
        friend bool operator==(const Option&, const Option&) = default;
    };
    struct PathRays {
        PathId path;
        bool line = true, nextEvents = true;
        friend bool operator==(const PathRays&, const PathRays&) = default;
    };
    struct VertexRays {
        VertexId vertex;
        bool incoming = true, outgoing = true, nextEvents = true;
        friend bool operator==(const VertexRays&, const VertexRays&) = default;
    };
    std::optional<std::size_t> reference;   ///< index into the session's images
    std::vector<Option> options;
    std::vector<PathRays> paths;            ///< those that are drawn otherwise than the options say
    std::vector<VertexRays> vertices;
    friend bool operator==(const SavedView&, const SavedView&) = default;
};

/// A value: copies share images, scene and columns, which never change. Every part may be absent.
struct Session {
    std::optional<ServerInfo> info;
    std::optional<Camera> camera;
    std::shared_ptr<const std::vector<Mesh>> meshes;       ///< null: none
    std::shared_ptr<const SurfaceField> surface;           ///< 3D data on `meshes`; null: none
    std::vector<ImageEntry> images;
    std::size_t currentImage = 0;                          ///< index into `images`; without meaning if there are none
    std::vector<std::shared_ptr<const Trace>> traces;      ///< newest first; never null
    std::vector<std::size_t> shown;                        ///< indices into `traces`: those that views show, in order
    Selection::State selection;
    std::string notes;                                     ///< about the whole session, in UTF-8
    std::vector<PixelNote> pixelNotes;
    std::optional<SavedFilter> filter;                     ///< nothing: none was asked for
    std::optional<SavedView> view;                         ///< nothing: as a program likes
};

/// What the models hold, without notes. Costs no copy, except of an image that is still rendering (others write to it):
/// call it in the thread of the models, and save in any other.
Session sessionOf(const Dataset& dataset, const Selection& selection);

/// Puts a session in the place of what the models hold. Each listener is told once. Thread of the models.
void show(const Session& session, Dataset& dataset, Selection& selection);

/// Writes a session. The file appears, or takes the place of an older one, when it is complete and on the disk: whatever
/// ends the program or the machine meanwhile, the old file or the new one is there, whole. (What was begun may remain
/// beside it: a hidden file whose name ends in ".tmp.emca".) A symbolic link stays and permissions too.
/// Any thread. Costs about a copy of the largest trace in memory.
/// \param observer  progress, and a flag to give up; previews do not occur
/// Errors: fileUnwritable; tooLarge (a trace beyond 1 GiB); invalidArgument (surface layers without the meshes they lie
/// on, images whose channels do not fit their values); cancelled. The old file is as it was.
Result<void> saveSession(const std::filesystem::path& file, const Session& session, const RequestObserver& observer = {});

/// What a file held.
struct OpenedSession {
    Session session;               ///< what could be read
    bool whole = true;             ///< nothing was cut off or damaged
    std::vector<std::string> notices;  ///< what is missing, damaged or unknown to this version: sentences for people
    std::string software;          ///< product and version that saved it
    std::uint64_t saved = 0;       ///< when: seconds since 1970, UTC; 0 if not known
};

struct OpenOptions {
    /// Most bytes that a file may unpack to, besides the limit that its own size sets: 1 GiB and 256 times its size.
    std::uint64_t maximumBytes = std::uint64_t(64) << 30;
};

/// Reads a session, as far as it is whole. Files of earlier versions open; so do files of later ones, without what this
/// version does not know, unless they say that they need a newer program. Any bytes are safe to open. Any thread.
/// Columns look into memory that was read once and is shared.
/// Errors: fileNotFound, fileUnreadable (no session, or cut before anything was saved), versionMismatch, outOfMemory,
/// cancelled. Everything else is told by notices.
Result<OpenedSession> openSession(const std::filesystem::path& file, const OpenOptions& options = {},
                                  const RequestObserver& observer = {});

/// Whether a file begins as a session does, whatever its name is. False for what cannot be read.
bool isSession(const std::filesystem::path& file);

}  // namespace emca::client
