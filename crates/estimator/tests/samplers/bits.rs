//! The same bits by all instructions, and any sample by itself.

use twoforms_estimator::numbers::Numbers;
use twoforms_estimator::sampler::{Parts, ROW, Row, Sampler};
use twoforms_estimator::xi::Key;
use twoforms_geometry::lanes::Instructions;

use super::points::{stream, words, words_by};

/// Pairs that a sample takes: beyond the dimensions of `halton`.
const PAIRS: usize = 10;

#[test]
fn bits_do_not_depend_on_the_instructions() {
    for &sampler in Sampler::ALL {
        for n in [1, 5, 64, 1000] {
            let stream = stream(sampler, sampler.rounded(n), 21, 3);
            let scalar = words_by(Instructions::SCALAR, &stream, PAIRS);
            for instructions in Instructions::all() {
                assert_eq!(words_by(instructions, &stream, PAIRS), scalar, "{sampler}, {instructions:?}");
            }
        }
    }
}

#[test]
fn any_sample_can_be_asked_for_by_itself() {
    for &sampler in Sampler::ALL {
        let stream = stream(sampler, sampler.rounded(300), 22, 1);
        let all = words(&stream, PAIRS);
        for index in [0, 1, 17, 128, 299] {
            assert_eq!(stream.xi(index, PAIRS).words(0), all[index as usize], "{sampler}, sample {index}");
        }
    }
}

/// Samples of many streams side by side are those of each stream.
#[test]
fn rows_hold_the_samples_of_their_streams() {
    const EACH: u32 = 4;
    const ESTIMATES: usize = 3 * ROW;
    // Some of the estimates that lie side by side share a stream, all of the last two rows.
    let streams: [u32; ESTIMATES] = std::array::from_fn(|k| 100 + if k < ROW { k as u32 / 5 } else { 7 });
    let parts: [u32; ESTIMATES] = std::array::from_fn(|k| 11 + k as u32 % 4);
    let rows: Vec<Row> =
        (0..ESTIMATES).step_by(ROW).flat_map(|from| [0, 1, 3].map(|index| Row { from, index })).collect();
    for &sampler in Sampler::ALL {
        let n = sampler.rounded(64);
        let all =
            Parts { sampler, key: Key::new([23]), n, each: EACH, streams: [&[n; ESTIMATES], &streams], parts: &parts };
        let alone = |replicate: u32| words(&stream(sampler, n, 23, replicate), PAIRS);
        let alone: Vec<_> = (100..108).map(alone).collect();
        for instructions in Instructions::all() {
            for few in rows.chunks(4) {
                let mut numbers = Numbers::new(PAIRS);
                all.fill(instructions, few, &mut numbers);
                for (offset, (row, k)) in few.iter().flat_map(|row| (0..ROW).map(move |k| (row, k))).enumerate() {
                    let estimate = row.from + k;
                    let index = parts[estimate] * EACH + row.index;
                    let expected = &alone[streams[estimate] as usize - 100][index as usize];
                    assert_eq!(&numbers.words(offset), expected, "{sampler}, {row:?}, {k}");
                }
            }
        }
    }
}
