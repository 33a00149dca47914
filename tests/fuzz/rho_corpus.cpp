// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Writes the fuzzer's first corpus: rhview_rho_corpus FOLDER

#include "rho_corpus.h"

#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: rhview_rho_corpus FOLDER\n", stderr);
        return 2;
    }
    return rhview::write_corpus(argv[1]).size() == 8 ? 0 : 1;
}
