/* For dlopen_gears: every GL and GLX function is a pointer that dlgl.c fills through dlopen, half of
 * them with dlsym and half with glXGetProcAddressARB. Nothing is linked with libGL. */
#ifndef DLGL_H
#define DLGL_H
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>

#define DLGL_FUNCTIONS(X) \
    X(glBegin) X(glClear) X(glClearColor) X(glDisable) X(glEnable) X(glEnd) X(glFinish) X(glFrustum) X(glGetError) \
    X(glGetFloatv) X(glGetIntegerv) X(glGetString) X(glLightfv) X(glLightModelfv) X(glLoadIdentity) X(glLoadMatrixf) \
    X(glMaterialf) X(glMaterialfv) X(glMatrixMode) X(glNormal3d) X(glPixelStorei) \
    X(glPopMatrix) X(glPushMatrix) X(glReadBuffer) X(glReadPixels) X(glRotated) X(glScaled) \
    X(glScissor) X(glShadeModel) X(glTranslated) X(glVertex3d) X(glViewport) \
    X(glXChooseFBConfig) X(glXChooseVisual) X(glXCreateContext) X(glXDestroyContext) \
    X(glXGetVisualFromFBConfig) X(glXMakeCurrent) X(glXSwapBuffers) X(glXGetProcAddressARB)

#define DLGL_DECLARE(name) extern __typeof__(name) *dl_##name;
DLGL_FUNCTIONS(DLGL_DECLARE)
#undef DLGL_DECLARE

void dlgl_load(void);

#ifndef DLGL_IMPLEMENTATION
#define glBegin dl_glBegin
#define glClear dl_glClear
#define glClearColor dl_glClearColor
#define glDisable dl_glDisable
#define glEnable dl_glEnable
#define glEnd dl_glEnd
#define glFinish dl_glFinish
#define glFrustum dl_glFrustum
#define glGetError dl_glGetError
#define glGetFloatv dl_glGetFloatv
#define glGetIntegerv dl_glGetIntegerv
#define glGetString dl_glGetString
#define glLightfv dl_glLightfv
#define glLightModelfv dl_glLightModelfv
#define glLoadIdentity dl_glLoadIdentity
#define glLoadMatrixf dl_glLoadMatrixf
#define glMaterialf dl_glMaterialf
#define glMaterialfv dl_glMaterialfv
#define glMatrixMode dl_glMatrixMode
#define glNormal3d dl_glNormal3d
#define glPixelStorei dl_glPixelStorei
#define glPopMatrix dl_glPopMatrix
#define glPushMatrix dl_glPushMatrix
#define glReadBuffer dl_glReadBuffer
#define glReadPixels dl_glReadPixels
#define glRotated dl_glRotated
#define glScaled dl_glScaled
#define glScissor dl_glScissor
#define glShadeModel dl_glShadeModel
#define glTranslated dl_glTranslated
#define glVertex3d dl_glVertex3d
#define glViewport dl_glViewport
#define glXChooseFBConfig dl_glXChooseFBConfig
#define glXChooseVisual dl_glXChooseVisual
#define glXCreateContext dl_glXCreateContext
#define glXDestroyContext dl_glXDestroyContext
#define glXGetVisualFromFBConfig dl_glXGetVisualFromFBConfig
#define glXMakeCurrent dl_glXMakeCurrent
#define glXSwapBuffers dl_glXSwapBuffers
#define glXGetProcAddressARB dl_glXGetProcAddressARB
#endif
#endif
