/* SPDX-FileCopyrightText: 2026 The rhview authors
   SPDX-License-Identifier: MIT */

/**
 * \file
 * rhview for C, and for every language that calls C: static triangles and cameras go in, the cheapest list
 * of draw calls that still shows every visible pixel comes out. Your renderer executes it.
 *
 * Order of the calls:
 *
 *     once       rhview_chains_build (where objects have levels of detail)
 *                rhview_scene_create   rhview_scene_add_batch…   rhview_scene_build
 *                upload rhview_scene_indices   rhview_view_create (one per camera)
 *     a frame    rhview_scene_begin_frame   rhview_scene_move_object (of those that are due)
 *                rhview_view_absorb, rhview_view_set_camera (each view)   rhview_plan_views
 *                draw rhview_view_plan (each view)   rhview_scene_end_frame
 *
 * Errors: a function that returns `rhview_status` changes nothing when it returns another than RHVIEW_OK;
 * `rhview_last_error` then says in a sentence why. No exception crosses this border. A debug build of the
 * library may also assert what only the caller can know.
 *
 * Structures that begin with `size` are set to zero first, `size` to their sizeof: a zero is the default of
 * every other field. So structures can grow: one that is shorter than the library's is taken with zeros
 * behind it; of one that is longer, what the library does not know must be zero. Structures without `size`
 * are elements of arrays and never change.
 *
 * Threads: views are independent, each may be used by a thread of its own. Nothing changes a scene while its
 * views are created or planned. No thread is started unless `rhview_workers` says so. Floats, matrices and
 * units: docs/conventions.md (right-handed, columns, metres, counter-clockwise fronts).
 */
#ifndef RHVIEW_RHVIEW_H
#define RHVIEW_RHVIEW_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(RHVIEW_BUILDS_C_LIBRARY)
#define RHVIEW_API __declspec(dllexport)
#elif defined(_WIN32)
#define RHVIEW_API __declspec(dllimport)
#elif defined(__GNUC__)
#define RHVIEW_API __attribute__((visibility("default")))
#else
/** Marks what the library exports. */
#define RHVIEW_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Counts up with every function and field added to this header. The soname changes with what is removed. */
#define RHVIEW_C_API_VERSION 2u

/** `rhview_object_state::last_seen_frame` of an object that was never seen. */
#define RHVIEW_NEVER UINT64_MAX

/** How a call ended: one of the RHVIEW_ constants below. */
typedef int32_t rhview_status;
enum {
    RHVIEW_OK = 0,
    RHVIEW_INVALID_ARGUMENT = 1, /**< null, out of range, or a structure of unknown size */
    RHVIEW_INVALID_DATA = 2,     /**< triangles, a camera or a file that cannot be right */
    RHVIEW_WRONG_STATE = 3,      /**< not now: before the build, or after it */
    RHVIEW_OUT_OF_MEMORY = 4,
    RHVIEW_INTERNAL_ERROR = 5 /**< a mistake of the library's: please report it */
};

/** The C_API_VERSION that the library was built with: at least the header's, or functions are missing. */
RHVIEW_API uint32_t rhview_c_api_version(void);
/** The release, "0.1.0". */
RHVIEW_API const char* rhview_version(void);
/** Why the last call of this thread that failed did; valid until its next one fails. Never null. */
RHVIEW_API const char* rhview_last_error(void);

/* Memory and threads ----------------------------------------------------------------------------------- */

/** Where the library's memory comes from. Both functions may be called by any thread that calls rhview. */
typedef struct rhview_allocator {
    size_t size;
    void* user; /**< first argument of both */
    /** `alignment` is a power of two. Null: there is none, and the call ends with RHVIEW_OUT_OF_MEMORY. */
    void* (*allocate)(void* user, size_t bytes, size_t alignment);
    void (*release)(void* user, void* memory); /**< what `allocate` gave, never null */
} rhview_allocator;

/**
 * All memory of the library comes from `allocator` from now on (null: malloc, as at first), except that of
 * oneTBB's scheduler, of thrown exceptions, and of rhview_last_error's sentences.
 * RHVIEW_WRONG_STATE while memory from the allocator before is in use: destroy scenes and views first.
 * Not while another thread calls the library.
 */
RHVIEW_API rhview_status rhview_set_allocator(const rhview_allocator* allocator);

/**
 * Threads that a call may use; null, or all zero: the calling one alone. With `run`, the engine's job system
 * gives them and no thread is started; without, those beyond the first are oneTBB's own.
 */
typedef struct rhview_workers {
    size_t size;
    uint32_t thread_count; /**< at a time, the calling one among them; 0 is 1 */
    /** Calls `share(job, i)` once for each i below `count`, on any threads and in any order, also one after
        the other, and returns when all have returned. */
    void (*run)(void* user, uint32_t count, void (*share)(void* job, uint32_t index), void* job);
    void* user;
} rhview_workers;

/* What things cost --------------------------------------------------------------------------------------- */

/** What asking the device costs, ns: a query with b boxes that cover p pixels and on which d draws hang takes
    query_ns + b·box_ns + p·pixel_ns + d·draw_ns; a frame with queries frame_ns once. */
typedef struct rhview_query_costs {
    double frame_ns, query_ns, box_ns, pixel_ns, draw_ns;
} rhview_query_costs;

/** What drawing costs on this machine, ns. Finite, none negative. */
typedef struct rhview_costs {
    size_t size;
    double index_ns;               /**< an index */
    double draw_ns;                /**< a draw call, or a part of a multi-draw */
    double call_ns;                /**< a multi-draw's call, once per batch; 0 for plain draws */
    double shown_index_ns;         /**< an index in the frustum, shading included; 0: `index_ns` */
    uint32_t has_hardware_queries; /**< not 0: the renderer has occlusion queries with conditional draws */
    uint32_t has_box_pass;         /**< not 0: it writes a bit per query and draws indirectly */
    rhview_query_costs hardware_queries, box_pass;
} rhview_costs;

/** A frame of yours: what was submitted, and how long it took. */
typedef struct rhview_frame_sample {
    double indices, draw_calls, time_ns;
} rhview_frame_sample;

/** Costs from a profile that `rhview calibrate` wrote. `is_multi_draw` not 0: for a renderer that draws a
    batch's ranges in one call. RHVIEW_INVALID_DATA: the sentence names file, place and mend. */
RHVIEW_API rhview_status rhview_costs_load(const char* file, uint32_t is_multi_draw, rhview_costs* costs);
/** Fits `index_ns` and `draw_ns` to at least 10 measured frames that differ in both; the rest is left as it
    is. RHVIEW_INVALID_DATA: these frames don't tell. */
RHVIEW_API rhview_status rhview_costs_fit(const rhview_frame_sample* samples, size_t count,
                                          rhview_costs* costs);

/* Levels of detail --------------------------------------------------------------------------------------- */

/** Chains of levels of detail, one per mesh of moving objects. */
typedef struct rhview_chains rhview_chains;

/** A mesh in its own space. The arrays are read until the call returns. */
typedef struct rhview_mesh {
    const float* positions; /**< x, y, z */
    size_t position_stride; /**< bytes from one to the next; 0: 12. Others cost a copy */
    size_t vertex_count;
    const void* indices; /**< three per triangle */
    size_t index_count;
    uint32_t index_bytes; /**< 2 or 4; 0 is 4 */
    uint32_t reserved;
} rhview_mesh;

/** How many levels, how they end, and which threads make them. */
typedef struct rhview_chain_options {
    size_t size;
    double ratio;                  /**< of a level's indices to those of the one before, 0.1 to 0.8; 0: 0.5 */
    uint32_t min_triangles;        /**< no level is asked to get smaller; 0: 32 */
    uint32_t locks_borders;        /**< not 0: edges of one triangle stay, so that neighbours keep fitting */
    uint32_t forbids_sloppy;       /**< not 0: rather no level than one that ignores topology */
    const rhview_workers* workers; /**< null: the calling thread */
    /** As that of `rhview_build_options`. */
    int32_t (*progress)(void* user, double share);
    void* progress_user;
} rhview_chain_options;

/** A way of drawing a mesh. */
typedef struct rhview_level {
    uint32_t first_index; /**< level 0: into the mesh's indices; others: into `rhview_chain::indices` */
    uint32_t index_count;
    float error;        /**< proven: no point of level and mesh is farther from the other; in mesh units */
    uint32_t is_sloppy; /**< not 0: it ignores topology */
} rhview_level;

/** One mesh's levels; valid as long as the chains. */
typedef struct rhview_chain {
    size_t size;
    const rhview_level* levels; /**< the finest first: the mesh itself */
    size_t level_count;
    const uint32_t* indices; /**< of level 1 and on, to upload; values are into the mesh's vertices */
    size_t index_count;
    uint64_t vertex_count; /**< of the mesh: to see that a loaded chain is this mesh's */
    const char* end;       /**< why there is no further level: the end of a sentence */
} rhview_chain;

/** One chain per mesh, in their order; `options` may be null. What cannot be simplified keeps level 0 alone.
    RHVIEW_INVALID_DATA names the mesh. */
RHVIEW_API rhview_status rhview_chains_build(const rhview_mesh* meshes, size_t count,
                                             const rhview_chain_options* options, rhview_chains** chains);
/** From a file that `rhview_chains_save` or `rhview bake` wrote. RHVIEW_INVALID_DATA: the sentence names
    file, place and mend. */
RHVIEW_API rhview_status rhview_chains_load(const char* file, rhview_chains** chains);
/** Whole or not at all: an old file is replaced when the new one is complete. */
RHVIEW_API rhview_status rhview_chains_save(const rhview_chains* chains, const char* file);
/** Null is allowed. Scenes that were given them keep what they need. */
RHVIEW_API void rhview_chains_destroy(rhview_chains* chains);
/** RHVIEW_INVALID_ARGUMENT: `number` is not below their count. */
RHVIEW_API rhview_status rhview_chains_get(const rhview_chains* chains, uint32_t number, rhview_chain* chain);

/* The scene ---------------------------------------------------------------------------------------------- */

/** Static triangles, and the objects that move among them. */
typedef struct rhview_scene rhview_scene;

/** An axis-aligned box, both ends included. */
typedef struct rhview_box {
    float min[3], max[3]; /**< in the scene's coordinates */
} rhview_box;

/** Where the scene lies, and how many objects it has at most. */
typedef struct rhview_scene_options {
    size_t size;
    double origin[3];            /**< world position of the zero of every vertex and box */
    uint32_t max_objects;        /**< at a time */
    const rhview_chains* chains; /**< of its objects; may be null. Since version 2 */
} rhview_scene_options;

/** Triangles of one material in one vertex buffer. The arrays are read until `rhview_scene_build` returns. */
typedef struct rhview_batch {
    size_t size;
    const float* positions; /**< x, y, z */
    size_t position_stride; /**< bytes from one to the next; 0: 12. Others cost a copy while building */
    size_t vertex_count;
    const void* indices; /**< three per triangle */
    size_t index_count;
    uint32_t index_bytes;  /**< 2 or 4; 0 is 4 */
    uint32_t is_two_sided; /**< not 0: drawn from behind too */
} rhview_batch;

/** How fine to build, with which threads, and who is told how far it is. */
typedef struct rhview_build_options {
    size_t size;
    const rhview_costs* costs;   /**< decides the granularity; null: a desktop GPU's */
    uint32_t max_leaf_triangles; /**< 0: chosen by the costs */
    uint32_t has_no_replicas; /**< not 0: no second copies of indices, which may take as much memory again */
    const rhview_workers* workers; /**< null: the calling thread */
    /** Now and then, by one thread at a time, with the share that is done; 0 stops the build. May be null. */
    int32_t (*progress)(void* user, double share);
    void* progress_user;
} rhview_build_options;

/** `options` may be null: no origin, no objects. Destroy the scene; it stays until its views are gone too. */
RHVIEW_API rhview_status rhview_scene_create(const rhview_scene_options* options, rhview_scene** scene);
/** Null is allowed. */
RHVIEW_API void rhview_scene_destroy(rhview_scene* scene);
/** Batches are numbered from 0. Before the build. `batch_number` may be null. */
RHVIEW_API rhview_status rhview_scene_add_batch(rhview_scene* scene, const rhview_batch* batch,
                                                uint32_t* batch_number);
/** Once; `options` may be null. A scene without batches is built too: it has objects alone.
    RHVIEW_INVALID_DATA names the batch and the triangle; the scene can then be built again. */
RHVIEW_API rhview_status rhview_scene_build(rhview_scene* scene, const rhview_build_options* options);
/** What to upload in place of your index buffers: valid as long as the scene. Values are into the batch's own
    vertices; a triangle keeps the order of its corners. */
RHVIEW_API rhview_status rhview_scene_indices(const rhview_scene* scene, const uint32_t** indices,
                                              size_t* count);

/* Moving objects ----------------------------------------------------------------------------------------- */

/** Something that moves: what the library has to know of it. */
typedef struct rhview_object {
    size_t size;
    rhview_box box;       /**< holds all that is drawn of it */
    uint32_t index_count; /**< that drawing it takes, at full detail; 0: it is never asked about */
    uint32_t group;       /**< small numbers: objects of one can share an instanced call */
    /** No point of it moves faster, units per second: then it need not be moved while it is not seen. 0: no
        promise, it is moved in every frame. */
    double top_speed;
    uint32_t has_chain; /**< not 0: its mesh has levels of detail, those of `chain`. Since version 2 */
    uint32_t chain;     /**< into the scene's chains */
    double scale;       /**< the longest that a unit of its mesh can be in the scene; 0 is 1 */
    uint32_t has_range; /**< not 0: nothing of it is ever outside `range`. Hidden with it, and with a top
                           speed, it need not be moved at all. Since version 2 */
    rhview_box range;   /**< a room, a court, all of a closed way */
    uint32_t reserved;
} rhview_object;

/** `number`: the lowest that is free, below `max_objects`. RHVIEW_WRONG_STATE: there are as many. */
RHVIEW_API rhview_status rhview_scene_add_object(rhview_scene* scene, const rhview_object* object,
                                                 uint32_t* number);
/** Its number is free again. */
RHVIEW_API rhview_status rhview_scene_remove_object(rhview_scene* scene, uint32_t number);
/** A new frame, at a time that is not before the last one's. */
RHVIEW_API rhview_status rhview_scene_begin_frame(rhview_scene* scene, double time_s);
/** The objects to move in this frame: those seen in the last one, and those whose promise ran out. Valid
    until the scene is changed. */
RHVIEW_API rhview_status rhview_scene_due_objects(rhview_scene* scene, const uint32_t** numbers,
                                                  size_t* count);
/** Where an object is now. One that moved farther than it promised counts as having jumped. */
RHVIEW_API rhview_status rhview_scene_move_object(rhview_scene* scene, uint32_t number,
                                                  const rhview_box* box);
/** Somewhere else at once: what is known of it is forgotten. */
RHVIEW_API rhview_status rhview_scene_jump_object(rhview_scene* scene, uint32_t number,
                                                  const rhview_box* box);
/** After the last view of the frame was planned: objects that no view draws at once need not be moved. */
RHVIEW_API rhview_status rhview_scene_end_frame(rhview_scene* scene);

/* Views -------------------------------------------------------------------------------------------------- */

/** A camera, and what it remembers: answers, and what was seen. */
typedef struct rhview_view rhview_view;

/** Whether what is probably hidden waits for a query. */
enum {
    RHVIEW_OCCLUSION_OFF = 0,
    RHVIEW_OCCLUSION_EXACT = 1, /**< left out only by a query of the same frame */
    RHVIEW_OCCLUSION_LATENT = 2 /**< trusts earlier frames: pixels may be missing */
};

/** What of z/w is inside. */
enum {
    RHVIEW_DEPTH_NEGATIVE_ONE_TO_ONE = 0, /**< OpenGL's default */
    RHVIEW_DEPTH_ZERO_TO_ONE = 1,         /**< Direct3D, Vulkan */
    RHVIEW_DEPTH_REVERSED = 2             /**< near 1, far 0; the far plane may be at infinity */
};

/** What a view plans by. */
typedef struct rhview_view_options {
    size_t size;
    const rhview_costs* costs; /**< null: a desktop GPU's, without queries */
    uint32_t occlusion;        /**< one of RHVIEW_OCCLUSION_; others than OFF need costs with queries */
    uint32_t band_count;       /**< at most 65,534 */
    const double* band_ends;   /**< distances where bands end, rising: `rhview_object_state::band` */
    double band_hysteresis;    /**< share of its end that a band is left late by, 0 to 1 */
} rhview_view_options;

/** A camera in double precision. */
typedef struct rhview_camera {
    size_t size;
    double camera_from_world[16];             /**< columns; rotation and translation, as a rule */
    double clip_from_camera[16];              /**< columns; perspective, orthographic or oblique */
    uint32_t clip_depth;                      /**< one of RHVIEW_DEPTH_ */
    uint32_t viewport_width, viewport_height; /**< pixels, 1 to 65,536 each */
} rhview_camera;

/** Of a scene that was built. `options` may be null. */
RHVIEW_API rhview_status rhview_view_create(rhview_scene* scene, const rhview_view_options* options,
                                            rhview_view** view);
/** Null is allowed. */
RHVIEW_API void rhview_view_destroy(rhview_view* view);
/** What levels may cost: error in the picture, or time. */
typedef struct rhview_level_bounds {
    size_t size;
    double max_error_px; /**< of an object in the picture; 0: full detail, unless the budget forbids it */
    double budget_ns;    /**< what the objects drawn at once may cost together; 0: anything */
    double object_ns;    /**< what an object costs whatever its level; indices and draws cost the view's */
} rhview_level_bounds;

/** The levels of objects in the next plans; null: full detail, as at first. */
RHVIEW_API rhview_status rhview_view_set_levels(rhview_view* view, const rhview_level_bounds* bounds);
/** For the next plans. RHVIEW_INVALID_DATA: no such camera can be. */
RHVIEW_API rhview_status rhview_view_set_camera(rhview_view* view, const rhview_camera* camera);
/** Plans views of one scene, each once, on `workers` (null: the calling thread). The plans are those of
    planning one after the other. RHVIEW_WRONG_STATE: a view has no camera yet. */
RHVIEW_API rhview_status rhview_plan_views(rhview_view* const* views, size_t count,
                                           const rhview_workers* workers);

/* The plan ----------------------------------------------------------------------------------------------- */

/** A range of the index buffer, drawn with one batch's state. */
typedef struct rhview_draw {
    uint32_t batch;
    uint32_t first_index; /**< into `rhview_scene_indices` */
    uint32_t index_count;
} rhview_draw;

/** An object to draw whole. */
typedef struct rhview_object_draw {
    uint32_t object;
    uint32_t level; /**< of detail; 0 is all of it */
} rhview_object_draw;

/** How a query is asked. */
enum { RHVIEW_HARDWARE_QUERY = 0, RHVIEW_BOX_PASS = 1 };

/** Is anything seen of some boxes, against the depth of what was drawn at once? */
typedef struct rhview_query {
    uint64_t ticket; /**< comes back with the answer */
    uint32_t first_box, box_count;
    uint32_t way; /**< RHVIEW_HARDWARE_QUERY or RHVIEW_BOX_PASS */
    uint32_t reserved;
} rhview_query;

/** Drawn if its query sees something, or if the device does not know. */
typedef struct rhview_conditional_draw {
    rhview_draw draw;
    uint32_t query; /**< into `rhview_plan::queries` */
} rhview_conditional_draw;

/** The same of an object. */
typedef struct rhview_conditional_object {
    uint32_t object, level, query;
} rhview_conditional_object;

/**
 * What to do in this order: `draws` and `objects`; the boxes of `queries` against that depth, without writing
 * colour or depth, from both sides, and widened by what your transform and rasteriser round
 * (`rhview_view_widen_boxes` does it; an engine
 * that cannot ask draws everything instead); `conditional_draws` and `conditional_objects`, each if its query
 * saw something. Draws of a batch stand together where that does not cost overdraw.
 */
typedef struct rhview_plan {
    size_t size;
    const rhview_draw* draws;
    size_t draw_count;
    const rhview_object_draw* objects; /**< by group, level and number */
    size_t object_count;
    const rhview_query* queries;
    size_t query_count;
    const rhview_box* boxes;
    size_t box_count;
    const rhview_conditional_draw* conditional_draws;
    size_t conditional_draw_count;
    const rhview_conditional_object* conditional_objects;
    size_t conditional_object_count;
    double predicted_ns;    /**< by the costs, without the objects */
    uint64_t hash;          /**< equal plans have equal ones on every machine */
    uint64_t nodes_visited; /**< of the octree, to plan it */
    /* Of the objects drawn at once that have chains, if the view has bounds for levels. Since version 2. */
    double level_error_px;  /**< the largest in the picture; infinite where nothing bounds it */
    double level_ns;        /**< what they cost */
    uint64_t level_indices; /**< what they draw */
    uint32_t misses_bound;  /**< not 0: `level_error_px` is above the bound, for the budget's sake */
    uint32_t misses_budget; /**< not 0: not even the coarsest levels are within it */
} rhview_plan;

/** An answer to a query, some frames later; `ticket` as in the plan. */
typedef struct rhview_answer {
    uint64_t ticket;
    uint32_t is_visible;
    uint32_t reserved;
} rhview_answer;

/** The last plan of the view; its arrays are valid until the view is planned again or destroyed. */
RHVIEW_API rhview_status rhview_view_plan(const rhview_view* view, rhview_plan* plan);

/** What the picture's rasteriser rounds to; its depth range is [0, 1]. */
typedef struct rhview_raster {
    size_t size;
    uint32_t subpixel_bits; /**< of a pixel, that vertices are moved to; 0: 8 */
    double depth_step;      /**< of a fixed-point depth buffer, 2 to the minus its bits; 0: floating point */
    /** By how much more clip coordinates of objects err than those of static triangles; 0: 3, enough for
        turned, moved and scaled ones, not for sheared ones. */
    double rounding_growth;
} rhview_raster;

/** How the widened boxes are drawn: all in float, depth clamped instead of clipped. */
typedef struct rhview_box_lens {
    size_t size;
    float clip_from_relative[16]; /**< columns; of positions relative to the eye */
    float eye_high[3];            /**< the scene's coordinates: a vertex v of the scene is drawn at */
    float eye_low[3];             /**< (v - eye_high) - eye_low */
    float depth_error[4];
    float nearer;  /**< to the clip z of a corner p add nearer · (depth_error · (|p|, 1) + shift · w) */
    float nearest; /**< clip z of a cover, at w = 1 */
} rhview_box_lens;

/** A box as a vertex shader takes it: 32 bytes. */
typedef struct rhview_wide_box {
    float low[3]; /**< relative to the eye */
    float shift;
    float high[3];
    /** Bits 2a and 2a + 1: the face to draw across axis a (0 none, 1 low, 2 high). Bit 6: draw the whole
        picture instead, at `nearest`. From bit 8 on: the number of the query. */
    uint32_t faces;
} rhview_wide_box;

/**
 * The plan's boxes widened so that one which is not seen proves that nothing in it would be: also what
 * rounding moves, by half a grid step of the rasteriser as by the last bit of a depth. Valid for renderers
 * that draw vertices by `lens` too. One per `rhview_plan::boxes`, until the view is planned again or
 * destroyed. `raster` may be null. RHVIEW_WRONG_STATE: not planned yet. About 60 ns a box.
 */
RHVIEW_API rhview_status rhview_view_widen_boxes(rhview_view* view, const rhview_raster* raster,
                                                 rhview_box_lens* lens, const rhview_wide_box** boxes,
                                                 size_t* count);
/** Answers to queries of earlier plans, in any order, as they come; of those not given within 16 frames it
    is assumed that something was seen. Unknown tickets are ignored. */
RHVIEW_API rhview_status rhview_view_absorb(rhview_view* view, const rhview_answer* answers, size_t count);

/* What was seen ------------------------------------------------------------------------------------------ */

/** Objects that turned with the last plan, by answers or by the plan itself, by number. */
typedef struct rhview_changes {
    size_t size;
    const uint32_t* became_visible;
    size_t became_visible_count;
    const uint32_t* became_hidden;
    size_t became_hidden_count;
} rhview_changes;

/** Of one object in one view. */
typedef struct rhview_object_state {
    size_t size;
    uint64_t last_seen_frame; /**< plans of this view before the one that showed it last; RHVIEW_NEVER */
    uint32_t is_visible;      /**< drawn at once, or seen by its query; while that is under way as before */
    uint32_t level;           /**< of detail, when it was drawn last */
    uint32_t band;            /**< of distance: how many of `band_ends` it is beyond */
} rhview_object_state;

/** The arrays are valid until the view is planned again or destroyed. */
RHVIEW_API rhview_status rhview_view_changes(const rhview_view* view, rhview_changes* changes);
/** Of an object that was never planned: hidden, never seen. */
RHVIEW_API rhview_status rhview_view_object_state(const rhview_view* view, uint32_t number,
                                                  rhview_object_state* state);

#ifdef __cplusplus
}
#endif

#endif
