//! Small images, made in memory.

use png::{BitDepth, ColorType, Encoder};

/// A PNG of red, green, blue and alpha, 8 bits each.
pub fn png(width: u32, height: u32, texels: &[[u8; 4]]) -> Vec<u8> {
    png_of(width, height, ColorType::Rgba, BitDepth::Eight, texels.as_flattened())
}

/// A PNG of any kind.
pub fn png_of(width: u32, height: u32, kind: ColorType, depth: BitDepth, bytes: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(kind);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().expect("a header can be written");
    writer.write_image_data(bytes).expect("the texels fit");
    writer.finish().expect("it ends");
    file
}

/// A grey baseline JPEG of blocks of 8 × 8 equal texels, `columns` of them in a row.
///
/// Its quantisation divides by 8, and the first coefficient of a block is 8 times its mean less 128: so the block's value
/// less 128 is what is written, as its difference from the last one. Differences of n bits have a code of 4 bits, n
/// itself; the 63 other coefficients are the code 0 of one bit, which ends a block.
pub fn jpeg(columns: u16, blocks: &[u8]) -> Vec<u8> {
    let (width, height) = (8 * columns, 8 * (blocks.len() as u16 / columns));
    let segment =
        |marker: u8, body: &[u8]| [&[0xFF, marker], &(body.len() as u16 + 2).to_be_bytes()[..], body].concat();
    let size = [&[8], &height.to_be_bytes()[..], &width.to_be_bytes(), &[1, 1, 0x11, 0]].concat();
    let differences = [&[0x00, 0, 0, 0, 12][..], &[0; 12], &(0..12).collect::<Vec<u8>>()].concat();
    let others = [&[0x10, 1][..], &[0; 15], &[0]].concat();
    let head = [
        vec![0xFF, 0xD8],
        segment(0xDB, &[&[0][..], &[8; 64]].concat()),
        segment(0xC0, &size),
        segment(0xC4, &differences),
        segment(0xC4, &others),
        segment(0xDA, &[1, 1, 0, 0, 63, 0]),
    ];
    [head.concat(), scan(blocks), vec![0xFF, 0xD9]].concat()
}

fn scan(blocks: &[u8]) -> Vec<u8> {
    let (mut bits, mut last) = (Vec::new(), 128);
    for block in blocks.iter().map(|&block| i32::from(block)) {
        let difference = block - last;
        let length = 32 - difference.unsigned_abs().leading_zeros();
        push(&mut bits, length, 4);
        let coded = if difference < 0 { difference + (1 << length) - 1 } else { difference };
        push(&mut bits, coded as u32, length);
        push(&mut bits, 0, 1);
        last = block;
    }
    bits.resize(bits.len().next_multiple_of(8), true);
    let bytes = bits.chunks(8).map(|byte| byte.iter().fold(0, |value, &bit| value << 1 | u8::from(bit)));
    bytes.flat_map(|byte| if byte == 0xFF { vec![0xFF, 0] } else { vec![byte] }).collect()
}

fn push(bits: &mut Vec<bool>, value: u32, count: u32) {
    bits.extend((0..count).rev().map(|bit| value >> bit & 1 == 1));
}
