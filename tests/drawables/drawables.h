/* Windows, pixmaps and pbuffers of one connection, and what a program sees of them. */
#define GL_GLEXT_PROTOTYPES 1
#define GLX_GLXEXT_PROTOTYPES 1
#include <GL/glx.h>
#include <X11/Xlib.h>

enum { SIZE = 64, RED = 0xff0000, GREEN = 0x00ff00, BLUE = 0x0000ff, WHITE = 0xffffff, GREY = 0x404040 };

extern Display *display;

/* Opens the connection; configs have a back buffer unless one is `single`. */
void open_display(int single);
/* A grey window at its own place on the screen, once it is visible; SIZE x SIZE pixels, or as wide as said. */
Window open_window(int place);
Window open_wide_window(int place, unsigned width);
/* Its drawable, which keeps its buffers while it is not current; Mesa drops those of a window that is its own drawable. */
GLXWindow drawn(Window window);
GLXPixmap open_pixmap(Pixmap *behind);
GLXPbuffer open_pbuffer(int width, int height);
GLXContext open_context(GLXContext share);
/* Draws to one drawable and reads from one, which may be another. */
void use(GLXDrawable draw, GLXDrawable read, GLXContext context);
void clear(int colour);
/* A rectangle in the middle of what is drawn to. */
void middle(int colour);
/* Binds a new framebuffer of SIZE x SIZE pixels. */
void use_framebuffer(void);
/* Prints the corner and the middle of a window or pixmap as X has them. Nothing is flushed before it but the connection. */
void shown(const char *what, Drawable drawable);
/* Prints the same of the read buffer, and the error that is set. */
void pixels(const char *what);

int is(const char *mode, const char *name);
/* Each runs a mode, or returns 0 where it has none of that name. */
int presents(const char *mode);
int swaps(const char *mode);
int reads(const char *mode);
int surfaces(const char *mode);
int growths(const char *mode);
