//! Reading textures: what materials show, each image once.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use gltf::json::texture::Info;
use gltf::json::{Image as Json, Texture as JsonTexture};

use crate::buffer;
use crate::decode::{LARGEST, Undecoded, decode};
use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::image::{Encoding, Image};
use crate::mapping::Mapping;
use crate::sampler::Sampler;
use crate::texture::Texture;
use crate::view::Run;

/// The most bytes of one image's file, and of all decoded images together.
const MOST: u64 = 1 << 30;

/// The textures that materials have asked for so far.
pub(crate) struct Textures<'a> {
    document: &'a Document<'a>,
    list: Vec<Texture>,
    /// Where in the file each texture stands, and what its integers mean.
    known: Vec<(usize, Encoding)>,
    /// By index in the file.
    images: BTreeMap<usize, Arc<Image>>,
    /// The files of those images that have one, by index.
    files: BTreeMap<usize, Vec<u8>>,
    held: u64,
}

/// What was read for the textures of a scene.
pub(crate) struct Gathered {
    pub textures: Vec<Texture>,
    /// In file order.
    pub images: Vec<Arc<Image>>,
    /// The bytes of image files, in file order.
    pub files: Vec<Vec<u8>>,
}

impl<'a> Textures<'a> {
    /// None yet.
    pub fn of(document: &'a Document<'a>) -> Self {
        let (list, known) = (Vec::new(), Vec::new());
        Self { document, list, known, images: BTreeMap::new(), files: BTreeMap::new(), held: 0 }
    }

    /// The mapping that `info` describes, of a texture whose integers mean `encoding`.
    pub fn mapping(&mut self, info: &Info, encoding: Encoding) -> Result<Mapping, Problem> {
        let index = info.index.value();
        let texture = self.texture(index, encoding)?;
        let broken = || malformed(format!("a use of textures[{index}]"), "has a KHR_texture_transform out of range");
        Mapping::new(texture, info).ok_or_else(broken)
    }

    /// All that was read.
    pub fn gathered(self) -> Gathered {
        let (images, files) = (self.images.into_values().collect(), self.files.into_values().collect());
        Gathered { textures: self.list, images, files }
    }

    fn texture(&mut self, index: usize, encoding: Encoding) -> Result<usize, Problem> {
        if let Some(known) = self.known.iter().position(|known| *known == (index, encoding)) {
            return Ok(known);
        }
        let place = format!("textures[{index}]");
        let texture = self.document.root.textures.get(index).ok_or_else(|| malformed(&place, "does not exist"))?;
        let sampler = self.sampler(texture, &place)?;
        let image = self.image(texture, &place)?;
        self.list.push(Texture { image, sampler, encoding });
        self.known.push((index, encoding));
        Ok(self.list.len() - 1)
    }

    fn sampler(&self, texture: &JsonTexture, place: &str) -> Result<Sampler, Problem> {
        let Some(index) = texture.sampler.map(|sampler| sampler.value()) else {
            return Ok(Sampler::default());
        };
        let sampler = self.document.root.samplers.get(index);
        let sampler = sampler.ok_or_else(|| malformed(place, "names a sampler that does not exist"))?;
        let unknown = || malformed(format!("samplers[{index}]"), "has a value that glTF does not know");
        Sampler::read(sampler).ok_or_else(unknown)
    }

    fn image(&mut self, texture: &JsonTexture, place: &str) -> Result<Arc<Image>, Problem> {
        let index = texture.source.value();
        if index == u32::MAX as usize {
            let what = format!("{place} has no image but in an extension, and PNG and JPEG alone are read");
            return Err(Problem::Unsupported { what, remedy: EXPORT.into() });
        }
        if let Some(image) = self.images.get(&index) {
            return Ok(image.clone());
        }
        let json = self.document.root.images.get(index);
        let json = json.ok_or_else(|| malformed(place, "names an image that does not exist"))?;
        let image = Arc::new(self.read(index, json)?);
        self.images.insert(index, image.clone());
        Ok(image)
    }

    fn read(&mut self, index: usize, json: &Json) -> Result<Image, Problem> {
        let file = json.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
        let place = match file {
            Some(uri) => format!("images[{index}] ({uri:?})"),
            None => format!("images[{index}]"),
        };
        let bytes = self.bytes(index, json)?;
        let decoded = decode(&bytes).map_err(|undecoded| problem(&place, undecoded))?;
        let name = json.name.as_deref().or(file).map_or_else(|| place.clone(), str::to_owned);
        let image = Image { name, width: decoded.width, height: decoded.height, texels: decoded.texels };
        self.held += image.bytes() as u64;
        if self.held > MOST {
            let what = format!("{place} takes the images of the scene beyond {} MiB", MOST >> 20);
            return Err(Problem::Unsupported { what, remedy: "scale images down".into() });
        }
        if file.is_some() {
            self.files.insert(index, bytes.into_owned());
        }
        Ok(image)
    }

    fn bytes(&self, index: usize, json: &Json) -> Result<Cow<'a, [u8]>, Problem> {
        let place = format!("images[{index}]");
        match (json.uri.as_deref(), json.buffer_view) {
            (Some(uri), _) if uri.starts_with("data:") => Ok(buffer::decode(&place, uri)?.into()),
            (Some(uri), _) => Ok(buffer::read_file(&place, uri, &self.document.folder, MOST)?.into()),
            (None, Some(view)) => {
                let length = self.document.root.buffer_views.get(view.value()).map_or(0, |view| view.byte_length.0);
                let run = Run { offset: 0, size: usize::try_from(length).unwrap_or(usize::MAX), count: 1 };
                self.document.elements(&place, view.value(), run)
            }
            (None, None) => Err(malformed(place, "has neither uri nor bufferView")),
        }
    }
}

const EXPORT: &str = "export the scene with PNG or JPEG images";

fn problem(place: &str, undecoded: Undecoded) -> Problem {
    match undecoded {
        Undecoded::Fault(fault) => malformed(place, fault),
        Undecoded::Format => Problem::Unsupported {
            what: format!("{place} is neither PNG nor JPEG, and others are not read"),
            remedy: EXPORT.into(),
        },
        Undecoded::Size(width, height) => Problem::Unsupported {
            what: format!("{place} has {width} × {height} texels, and {LARGEST} are the most that are read"),
            remedy: "scale it down".into(),
        },
    }
}
