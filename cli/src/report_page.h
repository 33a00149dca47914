// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

#include "rhview/base/result.h"

namespace rhview::cli {

/// The script that makes report pages: beside the installed program (../share/rhview), or in the source tree
/// that the program was built in. An error says where it was looked for.
Result<std::filesystem::path> find_report_script(const std::filesystem::path& program);

/// Makes `folder`/report.html from `folder`/compare.json, and the picture in `folder` if there is one.
Status make_report_page(const std::filesystem::path& script, const std::filesystem::path& folder);

}  // namespace rhview::cli
