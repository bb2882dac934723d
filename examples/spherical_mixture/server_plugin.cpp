#include "emca/server/tool_file.h"
#include "server_half.h"

static emca::ServerTool* makeTool() { return new mixture::MixtureTool; }

EMCA_SERVER_TOOL(makeTool)
