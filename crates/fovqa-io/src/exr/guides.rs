//! Motion and depth among the channels of a file.

use ::exr::meta::header::Header;
use fovqa_frame::{Guides, Motion, Plane};

use super::channels::{Channel, Channels, Match};
use super::pixels::{Planes, Request};
use super::window::Window;
use crate::decode::Note;
use crate::error::{ReadErrorKind, listed};
use crate::guides::{
    DepthChoice, Encoding, GuideOptions, GuideSearch, MotionChoice, Place, Reach, Sought, in_one,
};

/// What was found.
#[derive(Debug, Default)]
pub(crate) struct Found {
    motion: Option<([Channel; 2], Encoding)>,
    depth: Option<Channel>,
    pub(crate) search: GuideSearch,
}

/// Looks for what is asked for. `layer` is the full name of the colour's layer, empty for none.
pub(crate) fn find(
    headers: &[Header],
    options: &GuideOptions,
    place: Place,
    layer: &str,
) -> Result<Found, ReadErrorKind> {
    if options.is_none() {
        return Ok(Found::default());
    }
    let channels = Channels::of(headers);
    let finder = Finder { channels: &channels, place, layer };
    let (motions, depths) = (options.motion.choices(place), options.depth.choices(place));
    let motion = finder.motion(&motions)?;
    let taken: &[Channel] = motion.as_ref().map_or(&[], |(pair, _)| pair);
    let depth = finder.depth(&depths, taken)?;
    let found_motion = motion.as_ref().map(|(pair, _)| in_one(&pair.each_ref().map(name)));
    let search = GuideSearch {
        motion: Sought::motion(&motions).map(|sought| Sought { found: found_motion, ..sought }),
        depth: Sought::depth(&depths)
            .map(|sought| Sought { found: depth.as_ref().map(name), ..sought }),
        channels: channels.names().map(str::to_owned).collect(),
    };
    Ok(Found { motion, depth, search })
}

fn name(channel: &Channel) -> String {
    channel.name.clone()
}

struct Finder<'a> {
    channels: &'a Channels,
    place: Place,
    layer: &'a str,
}

impl Finder<'_> {
    /// The first choice that is there.
    fn motion(
        &self,
        choices: &[MotionChoice],
    ) -> Result<Option<([Channel; 2], Encoding)>, ReadErrorKind> {
        for choice in choices {
            let matches = self.matching(&choice.channels, choice.reach, &[]);
            if let Some(found) = self.one_of(&matches, choice.reach, "motion")? {
                let pair = [found.channels[0].clone(), found.channels[1].clone()];
                return Ok(Some((pair, choice.encoding)));
            }
        }
        Ok(None)
    }

    /// The first choice that is there and, where a bare name alone says so, not `taken`.
    fn depth(
        &self,
        choices: &[DepthChoice],
        taken: &[Channel],
    ) -> Result<Option<Channel>, ReadErrorKind> {
        for choice in choices {
            let found = match choice {
                DepthChoice::Channel(name, reach) => {
                    let names = std::slice::from_ref(name);
                    let matches = self.matching(names, *reach, taken);
                    self.one_of(&matches, *reach, "depth")?.map(|found| found.channels[0].clone())
                }
                DepthChoice::Only => self.channels.only().cloned(),
            };
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    fn matching<'b>(
        &'b self,
        names: &'b [String],
        reach: Reach,
        taken: &[Channel],
    ) -> Vec<Match<'b>> {
        let within_reach = |found: &Match<'_>| match reach {
            Reach::Named | Reach::Any => true,
            Reach::Own => self.is_own(found) && !taken.contains(found.channels[0]),
            Reach::OwnWithout(other) => {
                self.is_own(found)
                    && !taken.contains(found.channels[0])
                    && self.channels.get(found.lead, other).is_none()
            }
        };
        self.channels.matching(names).filter(within_reach).collect()
    }

    fn is_own(&self, found: &Match<'_>) -> bool {
        match self.place {
            Place::Alone => found.channels[0].bare,
            Place::BesideColour => {
                let rest = self.layer.strip_prefix(found.lead);
                found.lead.is_empty()
                    || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            }
        }
    }

    /// The only match, or that of the colour's first layer.
    fn one_of<'b>(
        &self,
        matches: &'b [Match<'b>],
        reach: Reach,
        what: &'static str,
    ) -> Result<Option<&'b Match<'b>>, ReadErrorKind> {
        let only = |fits: &dyn Fn(&Match<'_>) -> bool| {
            let mut fitting = matches.iter().filter(|found| fits(found));
            fitting.next().filter(|_| fitting.next().is_none())
        };
        let first = |name: &str| name.split('.').next().unwrap_or_default().to_ascii_lowercase();
        let layer = first(self.layer);
        let found = only(&|_| true)
            .or_else(|| only(&|found| reach == Reach::Named && found.lead.is_empty()))
            .or_else(|| only(&|found| first(found.lead) == layer));
        if found.is_none() && !matches.is_empty() {
            let sets = matches.iter().map(|found| {
                let names: Vec<String> = found.channels.iter().map(|c| c.name.clone()).collect();
                in_one(&names)
            });
            return Err(ReadErrorKind::SeveralGuides { what, channels: listed(sets) });
        }
        Ok(found)
    }
}

impl Found {
    /// What to read: the motion across, the motion down, the depth, as far as they are there. All
    /// of them must have the display window of the part `beside`.
    pub(crate) fn requests(
        &self,
        headers: &[Header],
        beside: &Header,
    ) -> Result<Vec<Request>, ReadErrorKind> {
        let display = |header: &Header| header.shared_attributes.display_window;
        let motion = self.motion.iter().flat_map(|(pair, _)| pair);
        let requests = motion.chain(&self.depth).map(|channel| {
            let header = &headers[channel.part];
            if display(header) != display(beside) {
                return Err(ReadErrorKind::DisplayWindows);
            }
            let window = Window::of(header)?;
            Ok(Request { part: channel.part, channels: vec![channel.index], window })
        });
        requests.collect()
    }

    /// The guides, from what the requests brought, and what there is to say about them.
    pub(crate) fn guides(
        &self,
        requests: &[Request],
        planes: impl IntoIterator<Item = Planes>,
    ) -> Result<(Guides, Option<Note>), ReadErrorKind> {
        let mut planes =
            requests.iter().zip(planes).map(|(request, planes)| plane(planes, &request.window));
        let mut next = || planes.next().unwrap_or_else(|| unreachable!("a plane a request"));
        let motion = match &self.motion {
            Some((_, encoding)) => Some(motion(next()?, next()?, encoding)?),
            None => None,
        };
        let depth = self.depth.as_ref().map(|_| next()).transpose()?;
        let covered = requests.iter().all(|request| request.window.data_covers_display());
        let note = (!covered).then_some(Note::UncoveredGuides);
        Ok((Guides { motion, depth }, note))
    }
}

fn plane(mut planes: Planes, window: &Window) -> Result<Plane, ReadErrorKind> {
    planes.blank(window.uncovered());
    let damaged = |detail| ReadErrorKind::Damaged { format: "OpenEXR", detail };
    Plane::new(window.display_width, window.display_height, planes.into_plane())
        .map_err(|error| damaged(error.to_string()))
}

fn motion(x: Plane, y: Plane, encoding: &Encoding) -> Result<Motion, ReadErrorKind> {
    let (width, height) = x.file_size();
    let motion = Motion::new(x, y, encoding.pixels([width, height]));
    // The planes are those of one display window.
    let motion = motion.ok_or(ReadErrorKind::DisplayWindows)?;
    Ok(motion.with_offset([encoding.offset; 2]))
}
