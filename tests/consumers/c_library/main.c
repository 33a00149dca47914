/* SPDX-FileCopyrightText: 2026 The rhview authors
   SPDX-License-Identifier: MIT

   What an engine in C does first; it needs the header and the library, nothing else. */

#include <rhview/rhview.h>
#include <stdio.h>

int main(void) {
    static const float positions[9] = {-1, 1, -10, 1, 1, -10, 0, 3, -10};
    static const unsigned short indices[3] = {0, 1, 2};
    rhview_batch batch = {0};
    rhview_camera camera = {0};
    rhview_plan plan = {0};
    rhview_scene* scene = NULL;
    rhview_view* view = NULL;
    int i;
    batch.size = sizeof batch;
    batch.positions = positions;
    batch.vertex_count = 3;
    batch.indices = indices;
    batch.index_count = 3;
    batch.index_bytes = 2;
    camera.size = sizeof camera;
    for (i = 0; i < 4; ++i) camera.camera_from_world[5 * i] = 1;
    camera.clip_from_camera[0] = camera.clip_from_camera[5] = 1;
    camera.clip_from_camera[11] = -1;
    camera.clip_from_camera[14] = 0.1;
    camera.clip_depth = RHVIEW_DEPTH_REVERSED;
    camera.viewport_width = camera.viewport_height = 100;
    plan.size = sizeof plan;
    if (rhview_c_api_version() < RHVIEW_C_API_VERSION || rhview_scene_create(NULL, &scene) != RHVIEW_OK ||
        rhview_scene_add_batch(scene, &batch, NULL) != RHVIEW_OK ||
        rhview_scene_build(scene, NULL) != RHVIEW_OK || rhview_view_create(scene, NULL, &view) != RHVIEW_OK ||
        rhview_view_set_camera(view, &camera) != RHVIEW_OK ||
        rhview_plan_views(&view, 1, NULL) != RHVIEW_OK || rhview_view_plan(view, &plan) != RHVIEW_OK) {
        fprintf(stderr, "%s\n", rhview_last_error());
        return 1;
    }
    printf("rhview %s: %u draw of %u indices\n", rhview_version(), (unsigned)plan.draw_count,
           (unsigned)plan.draws[0].index_count);
    i = plan.draw_count == 1 && plan.draws[0].index_count == 3 ? 0 : 2;
    rhview_view_destroy(view);
    rhview_scene_destroy(scene);
    return i;
}
