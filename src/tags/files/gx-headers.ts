/**
 * The headings of files of GX Works, in every language of its interface. Columns are found by them and never by their place: versions differ
 * in how many there are. A heading that is not here is said to be unknown, so a missing one loses nothing in silence.
 */

/** Columns that are read; those of comments are in {@link commentHeaders}. */
const headers = {
  class: ['Class', 'クラス', '类', '類別', '类别', '類', '클래스'],
  label: [
    'Label Name',
    'Label',
    'ラベル名',
    'ラベル',
    '标签名',
    '标签',
    '標籤名',
    '標籤名稱',
    '標籤',
    '레이블명',
    '레이블',
  ],
  type: ['Data Type', 'データ型', '数据类型', '資料類型', '數據類型', '데이터형', '데이터 타입'],
  constant: ['Constant', '定数', '定数値', '常数', '常數', '정수', '상수'],
  assign: [
    'Assign (Device/Label)',
    '割付(デバイス/ラベル)',
    '分配(软元件/标签)',
    '分配(軟元件/標籤)',
    '指派(軟元件/標籤)',
    '할당(디바이스/레이블)',
  ],
  device: [
    'Device',
    'Device Name',
    'Device No.',
    'Device Number',
    'デバイス',
    'デバイス名',
    'デバイス番号',
    '软元件',
    '软元件名',
    '软元件号',
    '軟元件',
    '軟元件名',
    '디바이스',
    '디바이스명',
  ],
  address: ['Address', 'アドレス', '地址', '位址', '주소'],
  external: [
    'Access from External Device',
    '外部機器からのアクセス',
    '外部设备访问',
    '从外部设备访问',
    '外部裝置存取',
    '從外部裝置存取',
    '외부 기기로부터의 액세스',
  ],
} as const satisfies Readonly<Record<string, readonly string[]>>

/** A column of a file of GX Works. */
export type GxColumn = keyof typeof headers

/** Comments as such, and by language: these are called alike in every language of the interface. The first that has a text is taken. */
const commentHeaders = [
  ...['Comment', 'コメント', '注释', '註解', '註釋', '코멘트'].flatMap((name) =>
    ['', 1, 2, 3, 4, 5].map((number) => `${name}${number}`),
  ),
  'Japanese/日本語',
  'English',
  'Chinese Simplified/简体中文',
  'Korean/한국어',
  'Chinese Traditional/繁體中文',
  'German/Deutsch',
  'Italian/Italiano',
]

function plain(text: string): string {
  return text.normalize('NFKC').toLowerCase().replace(/\s/g, '')
}

const byHeader: ReadonlyMap<string, GxColumn> = new Map(
  Object.entries(headers).flatMap(([column, names]) => names.map((name) => [plain(name), column as GxColumn] as const)),
)
const comments: ReadonlySet<string> = new Set(commentHeaders.map(plain))

/** Where the columns of a file are. */
export interface GxHeading {
  readonly columns: Readonly<Partial<Record<GxColumn, number>>>
  /** Places of the comments, the first ones first. */
  readonly comments: readonly number[]
}

/** What a row would be as a heading. Of two columns with the same name the first counts. */
export function headingOf(cells: readonly string[]): GxHeading {
  const found: Partial<Record<GxColumn, number>> = {}
  for (const [at, cell] of cells.entries()) {
    const column = byHeader.get(plain(cell))
    if (column !== undefined) found[column] ??= at
  }
  const places = [...cells.keys()].filter((at) => comments.has(plain(cells[at] ?? '')))
  return { columns: found, comments: places }
}

/** What a file with such a heading is; undefined when it is none of GX Works. */
export function gxKindOf({
  columns,
  comments: places,
}: GxHeading): 'gxWorks3Labels' | 'gxWorks2Labels' | 'deviceComments' | undefined {
  const { label, type, assign, device } = columns
  if (label !== undefined && type !== undefined) {
    if (assign !== undefined) return 'gxWorks3Labels'
    return device === undefined ? undefined : 'gxWorks2Labels'
  }
  return device !== undefined && places.length > 0 ? 'deviceComments' : undefined
}

/** The heading of global labels as GX Works3 in English writes it. */
export const gxWorks3Heading = [
  'Class',
  'Label Name',
  'Data Type',
  'Constant',
  'Initial Value',
  'Assign (Device/Label)',
  'Address',
  'Comment',
  'Comment 2',
  'Comment 3',
  'Comment 4',
  'Comment 5',
  'Japanese/日本語',
  'English',
  'Chinese Simplified/简体中文',
  'Korean/한국어',
  'Chinese Traditional/繁體中文',
  'German/Deutsch',
  'Italian/Italiano',
  'Reserved1',
  'Reserved2',
  'Reserved3',
  'Reserved4',
  'Remark',
  'System Label Relation',
  'System Label Name',
  'Attribute',
  'Access from External Device',
] as const

/** The heading of global labels as GX Works2 in English writes it. */
export const gxWorks2Heading = [
  'Class',
  'Label Name',
  'Data Type',
  'Constant',
  'Device',
  'Address',
  'Comment',
  'Remark',
  'Relation with System Label',
  'System Label Name',
  'Attribute',
] as const
