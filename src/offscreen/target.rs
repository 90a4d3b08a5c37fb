//! A framebuffer of the program's, and the framebuffers that it is split into.

use super::depths::SmallDepths;
use super::image::Image;
use super::images::Images;
use crate::atlas::{Surface, Tiles, ViewSet};
use crate::gl::{Attachment, FramebufferName, Gl, Object, TextureName, consts as c};
use crate::view::ViewIndex;

/// One framebuffer of the program's. More than 12 fields: what is attached to it, and what is made for that.
#[derive(Debug)]
pub struct Target {
    own: FramebufferName,
    /// Its number in the order of first use. Names are not used, because they depend on the layer's own.
    pub(super) number: Option<u32>,
    /// The framebuffers by view, of which the program's may be one; empty where it is not split.
    views: Vec<FramebufferName>,
    /// The number of the last change (see [`Images`]) after which the fields below were read.
    last_change: u64,
    /// The attachments of the program's framebuffer.
    pub attachments: Vec<Attachment>,
    draw_buffers: Vec<u32>,
    read_buffer: u32,
    /// For each attachment, the objects by view; none where it is not split.
    objects: Vec<Option<Vec<Object>>>,
    tiles: Tiles,
    /// The framebuffer with all views as layers.
    layered: Option<FramebufferName>,
    in_layers: bool,
    /// Small copies of its depths; none before the first, and none in it where there can be none.
    pub(super) depths: Option<Option<SmallDepths>>,
    /// It cannot be split.
    pub(super) refused: bool,
}

impl Target {
    pub(super) fn new(own: FramebufferName, tiles: Tiles) -> Target {
        Target {
            own,
            number: None,
            views: Vec::new(),
            // Nothing has been read yet.
            last_change: u64::MAX,
            attachments: Vec::new(),
            draw_buffers: Vec::new(),
            read_buffer: c::NONE,
            objects: Vec::new(),
            tiles,
            layered: None,
            in_layers: false,
            depths: None,
            refused: false,
        }
    }

    /// The program's name of the framebuffer.
    pub fn own(&self) -> FramebufferName {
        self.own
    }

    /// The framebuffers of the views that belong to the layer.
    pub(super) fn others(&self) -> impl Iterator<Item = FramebufferName> {
        let views = self.views.iter().copied().chain(self.layered);
        let small = self.depths.iter().flatten();
        let small = small.flat_map(SmallDepths::framebuffers);
        views.filter(|&name| name != self.own).chain(small)
    }

    /// The framebuffer with all views as layers, if there is one. The layer of a view is its slot in [`Surface::tiles`].
    pub fn layered(&self) -> Option<FramebufferName> {
        self.layered
    }

    /// Chooses how a view is selected from now on: by its layer (`layers`), or by its framebuffer.
    pub fn take_layers(&mut self, layers: bool) {
        self.in_layers = layers && self.layered.is_some();
    }

    /// The framebuffer of a view.
    pub fn view(&self, view: ViewIndex) -> FramebufferName {
        self.views.get(view.0 as usize).copied().unwrap_or(self.own)
    }

    /// Whether the views have framebuffers of their own.
    pub(super) fn is_made(&self) -> bool {
        !self.views.is_empty()
    }

    /// Whether a split object is attached.
    pub(super) fn is_split(&self) -> bool {
        self.objects.iter().any(Option::is_some)
    }

    /// Whether only depth or stencil is attached.
    pub fn is_depth_only(&self) -> bool {
        let points = [c::DEPTH_ATTACHMENT, c::STENCIL_ATTACHMENT];
        self.attachments.iter().all(|a| points.contains(&a.point))
    }

    /// Whether a face of a cube map is attached: such passes look in all directions.
    pub fn is_cube(&self) -> bool {
        self.attachments.iter().any(|a| a.face != 0)
    }

    /// Reads the attachments and buffers again after a change, and drops the views' framebuffers if they no longer match. Leaves the program's
    /// state as it is.
    pub(super) fn reattach(&mut self, gl: &Gl, images: &Images) {
        if std::mem::replace(&mut self.last_change, images.changes) == images.changes {
            return;
        }
        let bindings = [
            (c::DRAW_FRAMEBUFFER, c::DRAW_FRAMEBUFFER_BINDING),
            (c::READ_FRAMEBUFFER, c::READ_FRAMEBUFFER_BINDING),
        ]
        .map(|(target, binding)| (target, FramebufferName(gl.get_integer(binding) as u32)));
        gl.bind_framebuffer(c::FRAMEBUFFER, self.own);
        let attachments = gl.attachments(c::DRAW_FRAMEBUFFER);
        let buffers = gl.get_integer(c::MAX_DRAW_BUFFERS).clamp(1, 16) as u32;
        let mut draw_buffers: Vec<u32> = (0..buffers)
            .map(|at| gl.get_integer(c::DRAW_BUFFER0 + at) as u32)
            .collect();
        let used = draw_buffers.iter().rposition(|&b| b != c::NONE);
        draw_buffers.truncate(used.map_or(1, |at| at + 1));
        let read_buffer = gl.get_integer(c::READ_BUFFER) as u32;
        for (target, name) in bindings {
            gl.bind_framebuffer(target, name);
        }
        let objects: Vec<_> = attachments
            .iter()
            .map(|a| images.get(a.object).map(|image| image.views.clone()))
            .collect();
        let same = (&attachments, &draw_buffers, read_buffer, &objects)
            == (
                &self.attachments,
                &self.draw_buffers,
                self.read_buffer,
                &self.objects,
            );
        if !same {
            self.drop_views(gl);
            self.refused = false;
        }
        self.attachments = attachments;
        self.draw_buffers = draw_buffers;
        self.read_buffer = read_buffer;
        self.objects = objects;
    }

    fn drop_views(&mut self, gl: &Gl) {
        let small = self.depths.take().flatten();
        small.into_iter().for_each(|depths| depths.delete(gl));
        self.others().for_each(|name| gl.delete_framebuffer(name));
        self.views.clear();
        self.layered = None;
    }

    /// Makes the framebuffers of the views, where they do not exist yet; all attached objects have to be split. False where the driver refuses.
    /// Changes the framebuffer bindings.
    pub(super) fn make(&mut self, gl: &Gl, images: &Images) -> bool {
        if !self.views.is_empty() {
            return true;
        }
        let mut complete = true;
        let own = self.tiles.own();
        let of = |attachment: &Attachment| images.get(attachment.object);
        let arrays = |attachment| of(attachment).is_some_and(|image| image.array.is_some());
        let mut framebuffer = |attach: &dyn Fn(&Attachment, &Image)| {
            let name = gl.gen_framebuffer();
            gl.bind_framebuffer(c::FRAMEBUFFER, name);
            for attachment in &self.attachments {
                if let Some(image) = of(attachment) {
                    attach(attachment, image);
                }
            }
            gl.draw_buffers(&self.draw_buffers);
            gl.read_buffer(self.read_buffer);
            complete &= gl.check_framebuffer_status(c::DRAW_FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
            name
        };
        let views = ViewIndex::all(self.tiles.views).map(|view| {
            if view == own && !self.attachments.iter().any(arrays) {
                return self.own;
            }
            framebuffer(&|attachment, image| {
                let Some(&new) = image.views.get(view.0 as usize) else {
                    return;
                };
                let (object, target, layer) = match (&image.array, image.target) {
                    // The layer of the array is attached, not its texture view: Mesa 22.3 would blit from the first layer then.
                    (Some(array), _) => {
                        let layer = self.tiles.slot(view) as i32;
                        (Object::Texture(array.name), c::TEXTURE_2D_ARRAY, layer)
                    }
                    (None, c::RENDERBUFFER) => (new, image.target, 0),
                    (None, target) => (new, target, attachment.layer),
                };
                let like = Attachment {
                    layer,
                    ..*attachment
                };
                gl.attach_like(&like, object, target);
            })
        });
        self.views = views.collect();
        if !self.attachments.is_empty() && self.attachments.iter().all(arrays) {
            self.layered = Some(framebuffer(&|attachment, image| {
                let array = image.array.as_ref();
                let name = array.map_or(TextureName::ZERO, |array| array.name);
                let layered = Attachment {
                    layered: true,
                    ..*attachment
                };
                gl.attach_like(&layered, Object::Texture(name), c::TEXTURE_2D_ARRAY);
            }));
        }
        if !complete {
            self.drop_views(gl);
            self.refused = true;
        }
        complete
    }

    /// Sets the views that are drawn from now on.
    pub(super) fn show(&mut self, shown: ViewSet) {
        self.tiles.shown = shown;
    }

    /// Deletes the framebuffers of the views; only while its context is current.
    pub(super) fn delete(mut self, gl: &Gl) {
        self.drop_views(gl);
    }
}

impl Surface for Target {
    fn tiles(&self) -> Tiles {
        self.tiles
    }

    fn enter(&mut self, gl: &Gl, view: ViewIndex) -> i32 {
        if !self.in_layers {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.view(view));
        }
        0
    }

    fn bind_row(&mut self, gl: &Gl, row: u32) {
        // Each layer has one view.
        self.enter(gl, self.tiles.view_in(row));
    }
}
