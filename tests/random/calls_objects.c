/* Framebuffer objects, swaps. */
#include "random.h"

int framebuffer_bound(void)
{
    return bound(GL_DRAW_FRAMEBUFFER_BINDING) || bound(GL_READ_FRAMEBUFFER_BINDING);
}

static void framebuffer(void)
{
    struct context *c = R->now;
    uint32_t i = below(FRAMES);
    if (!c->framebuffers[0] && !R->begin) {
        glGenFramebuffers(FRAMES, c->framebuffers);
        glGenRenderbuffers(1, &c->renderbuffer);
        glBindRenderbuffer(GL_RENDERBUFFER, c->renderbuffer);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 32, 32);
    }
    GLenum target = ENUM(GL_FRAMEBUFFER, GL_FRAMEBUFFER, GL_DRAW_FRAMEBUFFER, GL_READ_FRAMEBUFFER);
    switch (below(9)) {
    case 0: case 1: case 2: CALL(glBindFramebuffer, GL_FRAMEBUFFER, 0u); break;
    case 3: CALL(glBindFramebuffer, target, 0u); break;
    case 4: case 5: {
        /* A complete one with a texture of its own, so that no draw samples its own target. */
        GLint before = 0;
        if (R->begin || bound(GL_ATTRIB_STACK_DEPTH)) /* see whole_mask() */
            break;
        glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
        CALL(glBindFramebuffer, target, c->framebuffers[i]);
        GLuint name = 40 + i;
        glBindTexture(GL_TEXTURE_2D, name);
        GLint unpack = 0;
        glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixel_source());
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)unpack);
        glBindTexture(GL_TEXTURE_2D, (GLuint)before);
        CALL(glFramebufferTexture2D, target, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, name, 0);
        if (chance(60)) {
            CALL(glFramebufferRenderbuffer, target, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, c->renderbuffer);
            if (target != GL_READ_FRAMEBUFFER)
                CALL(glClear, GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        }
        break;
    }
    case 6: tell(&R->answers, "%d.%d status 0x%x", R->step, R->part, CALL(glCheckFramebufferStatus, target)); break;
    case 7: {
        GLint value = -1;
        GLenum attachment = ENUM(GL_BACK, GL_DEPTH, GL_STENCIL, GL_BACK_LEFT, GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT);
        GLenum what = ENUM(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
        CALL(glGetFramebufferAttachmentParameteriv, target, attachment, what, &value);
        tell(&R->answers, "%d.%d attachment %d", R->step, R->part, value);
        break;
    }
    default:
        if (chance(50)) {
            CALL(glDeleteFramebuffers, 1, (const GLuint *)&c->framebuffers[i]);
            CALL(glGenFramebuffers, 1, &c->framebuffers[i]);
        } else {
            /* Overlapping rectangles are undefined. */
            CALL(glBlitFramebuffer, 0, 0, (int)below(17), (int)below(33), 17 + (int)below(20), (int)below(20), 40, 30,
                 PICK(GL_COLOR_BUFFER_BIT, GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT), PICK(GL_NEAREST, GL_LINEAR));
        }
    }
}

static void swap(void)
{
    if (R->begin || R->list)
        return;
    int shown = R->now->others && chance(50) ? R->now->drawable : R->now->draw;
    if (O.trace)
        fprintf(R->out, "%d.%d (swap%s)\n", R->step, R->part, shown == R->now->draw ? "" : " of the first drawable");
    W->swap(shown);
}

static void flush(void)
{
    if (chance(50))
        CALL0(glFlush);
    else
        CALL0(glFinish);
}

const struct generator object_calls[] = {{"framebuffer", FRAMEBUFFERS, 30, framebuffer}, {0}};
const struct generator swap_calls[] = {{"swap", SWAPS, 12, swap}, {"flush", SWAPS, 8, flush}, {0}};
