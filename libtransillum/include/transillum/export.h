// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

/// Marks the part of namespace transillum that a shared library exports. Public headers open the
/// namespace with it, so that what they declare is exported and nothing else is.
#define TRANSILLUM_API [[gnu::visibility("default")]]
