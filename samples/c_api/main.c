/* SPDX-FileCopyrightText: 2026 The rhview authors
   SPDX-License-Identifier: MIT

   An engine in C99: a wall, a thousand crates behind it and ten before it, two carts that drive, two round
   lamps with levels of detail, a camera and a shadow map. The engine's renderer is replaced by one that
   counts, and that answers occlusion queries from what it knows: the wall hides all that lies beyond it. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhview/rhview.h>

enum {
    CRATES = 1010,
    CARTS = 2,
    LAMPS = 2,
    THINGS = CARTS + LAMPS,
    FRAMES = 40,
    MAX_QUERIES = 4096,
    RINGS = 24
};
static const float WALL_Z = -20.0f;

typedef struct mesh {
    float* positions;
    uint32_t* indices;
    uint32_t vertex_count, index_count;
} mesh;

/* Adds a box's twelve triangles, fronts outside. */
static void add_box(mesh* m, const float low[3], const float high[3]) {
    static const uint32_t corners[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                         2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    int i, axis;
    for (i = 0; i < 36; ++i) m->indices[m->index_count++] = m->vertex_count + corners[i];
    for (i = 0; i < 8; ++i, ++m->vertex_count)
        for (axis = 0; axis < 3; ++axis)
            m->positions[3 * m->vertex_count + axis] = (i >> axis & 1) != 0 ? high[axis] : low[axis];
}

static mesh make_yard(void) {
    mesh m = {0};
    int i;
    const float low[3] = {-50, 0, -21}, high[3] = {50, 12, -20};
    m.positions = malloc(8 * 3 * sizeof(float) * (CRATES + 1));
    m.indices = malloc(36 * sizeof(uint32_t) * (CRATES + 1));
    if (m.positions == NULL || m.indices == NULL) exit(2);
    add_box(&m, low, high);
    for (i = 0; i < CRATES; ++i) {
        const float x = (float)(i % 25) * 3.0f - 36.0f;
        const float z = i < 1000 ? -25.0f - (float)(i / 25) * 2.0f : -10.0f;
        const float crate_low[3] = {x, 0, z}, crate_high[3] = {x + 1, 1, z + 1};
        add_box(&m, crate_low, crate_high);
    }
    return m;
}

/* A ball of radius 0.5. */
static mesh make_lamp(void) {
    mesh m = {0};
    const uint32_t around = 2 * RINGS;
    uint32_t ring, k;
    m.positions = malloc(3 * sizeof(float) * (RINGS + 1) * around);
    m.indices = malloc(6 * sizeof(uint32_t) * RINGS * around);
    if (m.positions == NULL || m.indices == NULL) exit(2);
    for (ring = 0; ring <= RINGS; ++ring)
        for (k = 0; k < around; ++k, ++m.vertex_count) {
            const double a = 3.14159265358979 * ring / RINGS, b = 3.14159265358979 * k / RINGS;
            m.positions[3 * m.vertex_count] = (float)(0.5 * sin(a) * cos(b));
            m.positions[3 * m.vertex_count + 1] = (float)(0.5 * cos(a));
            m.positions[3 * m.vertex_count + 2] = (float)(0.5 * sin(a) * sin(b));
        }
    for (ring = 0; ring < RINGS; ++ring)
        for (k = 0; k < around; ++k) {
            const uint32_t next = (k + 1) % around, here = ring * around, below = here + around;
            const uint32_t quad[6] = {here + k, here + next, below + k, here + next, below + next, below + k};
            memcpy(m.indices + m.index_count, quad, sizeof quad);
            m.index_count += 6;
        }
    return m;
}

/* A camera at `eye` that looks along -z; reversed depth, the far plane at infinity. */
static rhview_camera camera_at(double x, double y, double z) {
    const double focal = 1.0 / tan(0.5), near_plane = 0.1;
    rhview_camera camera;
    memset(&camera, 0, sizeof camera);
    camera.size = sizeof camera;
    camera.camera_from_world[0] = camera.camera_from_world[5] = camera.camera_from_world[10] = 1.0;
    camera.camera_from_world[12] = -x;
    camera.camera_from_world[13] = -y;
    camera.camera_from_world[14] = -z;
    camera.camera_from_world[15] = 1.0;
    camera.clip_from_camera[0] = focal * 9.0 / 16.0;
    camera.clip_from_camera[5] = focal;
    camera.clip_from_camera[11] = -1.0;
    camera.clip_from_camera[14] = near_plane;
    camera.clip_depth = RHVIEW_DEPTH_REVERSED;
    camera.viewport_width = 1280;
    camera.viewport_height = 720;
    return camera;
}

/* The sun's: straight down, orthographic, 200 m wide. */
static rhview_camera sun(void) {
    rhview_camera camera = camera_at(0, 0, 0);
    const double down[16] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -100, 1};
    const double flat[16] = {0.01, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, 0.005, 0, 0, 0, 1, 1};
    memcpy(camera.camera_from_world, down, sizeof down);
    memcpy(camera.clip_from_camera, flat, sizeof flat);
    return camera;
}

/* The renderer: counts, and knows what the wall hides. */
typedef struct renderer {
    size_t draws, conditional_draws, indices, executed_indices;
    rhview_answer answers[MAX_QUERIES];
    size_t answer_count;
    size_t lamp_indices;
} renderer;

static void draw(renderer* r, const rhview_draw* range) {
    ++r->draws;
    r->indices += range->index_count;
}

/* A lamp's level: which of the meshes is drawn. */
static void draw_object(renderer* r, const rhview_object_draw* object, const rhview_chain* lamp) {
    ++r->draws;
    if (object->object >= CARTS) r->lamp_indices += lamp->levels[object->level].index_count;
}

static void ask(renderer* r, const rhview_query* query, const rhview_box* boxes) {
    rhview_answer answer = {0};
    uint32_t i;
    answer.ticket = query->ticket;
    for (i = 0; i < query->box_count; ++i)
        if (boxes[query->first_box + i].max[2] > WALL_Z - 2.0f) answer.is_visible = 1;
    if (r->answer_count < MAX_QUERIES) r->answers[r->answer_count++] = answer;
}

static void draw_if_seen(renderer* r, uint32_t query, const rhview_draw* range) {
    ++r->conditional_draws;
    if (r->answers[query].is_visible) r->executed_indices += range->index_count;
}

/* [snippet] */
/* What is drawn at once, then the questions against that depth, then what hangs on their answers. */
static void execute(const rhview_plan* plan, const rhview_chain* lamp, renderer* r) {
    size_t i;
    for (i = 0; i < plan->draw_count; ++i) draw(r, &plan->draws[i]);
    for (i = 0; i < plan->object_count; ++i) draw_object(r, &plan->objects[i], lamp);
    for (i = 0; i < plan->query_count; ++i) ask(r, &plan->queries[i], plan->boxes);
    for (i = 0; i < plan->conditional_draw_count; ++i)
        draw_if_seen(r, plan->conditional_draws[i].query, &plan->conditional_draws[i].draw);
}
/* [/snippet] */

/* Ends the program with the library's sentence. */
static void check(rhview_status status, const char* what) {
    if (status == RHVIEW_OK) return;
    fprintf(stderr, "%s: %s\n", what, rhview_last_error());
    exit(1);
}

static rhview_costs costs_of_this_machine(void) {
    rhview_costs costs = {0};
    costs.size = sizeof costs;
    costs.index_ns = 3; /* guesses; `rhview calibrate` measures them, rhview_costs_load reads them */
    costs.draw_ns = 500;
    costs.has_hardware_queries = 1;
    costs.hardware_queries.query_ns = 400;
    costs.hardware_queries.box_ns = 50;
    costs.hardware_queries.draw_ns = 100;
    return costs;
}

/* Where a cart is: the first before the wall, the second far off. And a lamp: one near, one at the wall. */
static rhview_box box_of(uint32_t thing, double time_s) {
    static const rhview_box lamps[LAMPS] = {{{1, 1, 4}, {2, 2, 5}}, {{4, 9, -19}, {5, 10, -18}}};
    rhview_box box = {{0, 0, -15}, {2, 1, -14}};
    const float x = (float)(2.0 * time_s) + (thing == 0 ? 0.0f : 500.0f);
    if (thing >= CARTS) return lamps[thing - CARTS];
    box.min[0] += x;
    box.max[0] += x;
    return box;
}

/* Built here; an engine saves them with its meshes and loads them. */
static rhview_chains* make_chains(const mesh* lamp) {
    rhview_mesh source = {0};
    rhview_chains* chains = NULL;
    source.positions = lamp->positions;
    source.vertex_count = lamp->vertex_count;
    source.indices = lamp->indices;
    source.index_count = lamp->index_count;
    check(rhview_chains_build(&source, 1, NULL, &chains), "levels of detail");
    return chains;
}

/* Carts, then lamps: the lowest free numbers are given, so theirs are 0 and on. */
static void add_things(rhview_scene* scene, uint32_t lamp_index_count) {
    uint32_t i;
    for (i = 0; i < THINGS; ++i) {
        rhview_object thing = {0};
        uint32_t number = 0;
        thing.size = sizeof thing;
        thing.box = box_of(i, 0.0);
        thing.index_count = i < CARTS ? 3000 : lamp_index_count;
        thing.top_speed = i < CARTS ? 5 : 0.01;
        thing.has_chain = i >= CARTS;
        check(rhview_scene_add_object(scene, &thing, &number), "add an object");
        if (number != i) exit(2);
    }
}

static rhview_scene* make_scene(const mesh* yard, const rhview_costs* costs, const rhview_chains* chains) {
    rhview_scene_options options = {0};
    rhview_batch batch = {0};
    rhview_build_options build = {0};
    rhview_scene* scene = NULL;
    options.size = sizeof options;
    options.max_objects = THINGS;
    options.chains = chains;
    check(rhview_scene_create(&options, &scene), "create");
    batch.size = sizeof batch;
    batch.positions = yard->positions;
    batch.vertex_count = yard->vertex_count;
    batch.indices = yard->indices;
    batch.index_count = yard->index_count;
    check(rhview_scene_add_batch(scene, &batch, NULL), "add a batch");
    build.size = sizeof build;
    build.costs = costs;
    check(rhview_scene_build(scene, &build), "build");
    return scene;
}

static rhview_view* make_view(rhview_scene* scene, const rhview_costs* costs, uint32_t occlusion) {
    static const double bands[2] = {10, 40};
    rhview_view_options options = {0};
    rhview_view* view = NULL;
    options.size = sizeof options;
    options.costs = costs;
    options.occlusion = occlusion;
    options.band_ends = bands;
    options.band_count = 2;
    check(rhview_view_create(scene, &options, &view), "create a view");
    return view;
}

/* Those that are due; how many carts. */
static size_t move_things(rhview_scene* scene, double time_s) {
    const uint32_t* due = NULL;
    size_t count = 0, carts = 0, i;
    check(rhview_scene_due_objects(scene, &due, &count), "due objects");
    for (i = 0; i < count; ++i) {
        const rhview_box box = box_of(due[i], time_s);
        check(rhview_scene_move_object(scene, due[i], &box), "move an object");
        carts += due[i] < CARTS;
    }
    return carts;
}

static rhview_object_state state_of(const rhview_view* view, uint32_t number) {
    rhview_object_state state = {0};
    state.size = sizeof state;
    check(rhview_view_object_state(view, number, &state), "the state of an object");
    return state;
}

int main(void) {
    mesh yard = make_yard(), lamp = make_lamp();
    const rhview_costs costs = costs_of_this_machine();
    rhview_chains* chains = make_chains(&lamp);
    rhview_scene* scene = make_scene(&yard, &costs, chains);
    rhview_chain levels = {0};
    rhview_level_bounds bounds = {0};
    rhview_view *views[2], *camera = NULL;
    const uint32_t* indices = NULL;
    size_t index_count = 0, moved = 0, first_indices = 0;
    renderer pictures = {0}, shadows = {0};
    rhview_object_state cart, near_lamp, far_lamp;
    rhview_box_lens lens = {0};
    const rhview_wide_box* wide_boxes = NULL;
    size_t wide_count = 0;
    int frame, all_widened = 1;
    lens.size = sizeof lens;
    views[0] = camera = make_view(scene, &costs, RHVIEW_OCCLUSION_EXACT);
    views[1] = make_view(scene, &costs, RHVIEW_OCCLUSION_OFF);
    levels.size = sizeof levels;
    check(rhview_chains_get(chains, 0, &levels), "a chain"); /* upload its indices */
    add_things(scene, lamp.index_count);
    bounds.size = sizeof bounds;
    bounds.max_error_px = 1.0;
    check(rhview_view_set_levels(camera, &bounds), "bounds of levels");
    check(rhview_scene_indices(scene, &indices, &index_count), "indices"); /* upload them */

    for (frame = 0; frame < FRAMES; ++frame) {
        const double time_s = frame / 60.0;
        const rhview_camera eye = camera_at(0.02 * frame, 1.7, 10), light = sun();
        rhview_plan plan = {0}, shadow_plan = {0};
        plan.size = shadow_plan.size = sizeof plan;
        check(rhview_scene_begin_frame(scene, time_s), "begin a frame");
        moved += move_things(scene, time_s);
        check(rhview_view_absorb(camera, pictures.answers, pictures.answer_count), "answers");
        check(rhview_view_set_camera(views[0], &eye), "camera");
        check(rhview_view_set_camera(views[1], &light), "sun");
        check(rhview_plan_views(views, 2, NULL), "plan");
        check(rhview_view_plan(views[0], &plan), "the camera's plan");
        check(rhview_view_plan(views[1], &shadow_plan), "the sun's plan");
        check(rhview_view_widen_boxes(camera, NULL, &lens, &wide_boxes, &wide_count),
              "wide boxes"); /* upload them: a query draws these, by the lens */
        all_widened = all_widened && wide_count == plan.box_count;
        memset(&pictures, 0, sizeof pictures);
        memset(&shadows, 0, sizeof shadows);
        execute(&plan, &levels, &pictures);
        execute(&shadow_plan, &levels, &shadows);
        check(rhview_scene_end_frame(scene), "end a frame");
        if (frame == 0) first_indices = pictures.indices + pictures.executed_indices;
    }

    cart = state_of(camera, 0);
    near_lamp = state_of(camera, CARTS);
    far_lamp = state_of(camera, CARTS + 1);
    printf("%s %lu of %lu indices drawn in the last frame, %lu in the first; %lu in the shadow map\n",
           rhview_version(), (unsigned long)(pictures.indices + pictures.executed_indices),
           (unsigned long)index_count, (unsigned long)first_indices, (unsigned long)shadows.indices);
    printf("carts moved %lu times in %d frames; the first was last seen in frame %lu, in band %u\n",
           (unsigned long)moved, FRAMES, (unsigned long)cart.last_seen_frame, (unsigned)cart.band);

    printf("lamps at levels %u and %u of %lu: %lu of %lu indices, %lu in the shadow map\n",
           (unsigned)near_lamp.level, (unsigned)far_lamp.level, (unsigned long)levels.level_count,
           (unsigned long)pictures.lamp_indices, 2ul * lamp.index_count, (unsigned long)shadows.lamp_indices);

    rhview_view_destroy(views[0]);
    rhview_view_destroy(views[1]);
    rhview_scene_destroy(scene);
    rhview_chains_destroy(chains);
    free(yard.positions);
    free(yard.indices);
    free(lamp.positions);
    free(lamp.indices);
    /* Of what is behind the wall little is drawn, the cart out of sight is seldom moved, and the lamp at the
       wall is drawn coarser than the near one, in the camera's picture alone. */
    return pictures.indices + pictures.executed_indices < index_count / 4 && shadows.indices >= 36 * 1000 &&
                   cart.is_visible && cart.last_seen_frame == FRAMES - 1 && moved < FRAMES + FRAMES / 2 &&
                   near_lamp.level < far_lamp.level && far_lamp.level < levels.level_count &&
                   shadows.lamp_indices == 2 * lamp.index_count && all_widened
               ? 0
               : 1;
}
