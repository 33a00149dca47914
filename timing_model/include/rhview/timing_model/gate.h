// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Whether asking if something is hidden costs less than drawing it.
#pragma once

namespace rhview {

/// Whether the expected gain of a query, `p_hidden`·`render_ns`, exceeds its price. NaN in any of them is
/// "no": what is not known is drawn. Source: Guthe, Balázs & Klein 2006 (near-optimal hierarchical culling),
/// its rule reduced to one query of one thing.
constexpr bool worth_a_query(double p_hidden, double render_ns, double query_ns) {
    return p_hidden * render_ns > query_ns;
}

}  // namespace rhview
